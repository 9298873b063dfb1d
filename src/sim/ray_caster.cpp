#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
RTCRay ray(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float reach)
{
  RTCRay ray = {};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = reach;
  ray.mask = ~0U;
  return ray;
}
}  // namespace

struct RayCaster::Scene
{
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  Scene()
  {
    if (device == nullptr) throw std::runtime_error("the ray caster (Embree) cannot be started");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~Scene()
  {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void add(const PlacedMesh& placed)
  {
    const TriangleMesh& mesh = *placed.mesh;
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (const Eigen::Vector3f& vertex : mesh.vertices)
    {
      Eigen::Map<Eigen::Vector3f> world(vertices);
      world = (placed.T_world_mesh * vertex.cast<double>()).cast<float>();
      vertices += 3;
    }
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles)
      indices = std::copy(triangle.begin(), triangle.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);  // the id counts up from 0: the index of the mesh
    rtcReleaseGeometry(geometry);
  }
};

RayCaster::RayCaster(const std::vector<PlacedMesh>& meshes) : scene_(std::make_unique<Scene>())
{
  for (const PlacedMesh& placed : meshes)
  {
    for (const auto& triangle : placed.mesh->triangles)
      for (const std::uint32_t index : triangle)
        if (index >= placed.mesh->vertices.size())
          throw std::invalid_argument("a mesh's triangle names a vertex that it does not have");
    scene_->add(placed);
  }
  rtcCommitScene(scene_->scene);
}

RayCaster::~RayCaster() = default;

std::optional<RayHit> RayCaster::cast(const Eigen::Vector3f& origin,
                                      const Eigen::Vector3f& direction) const
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = {};
  query.ray = ray(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return RayHit{query.ray.tfar, query.hit.geomID, normal.normalized()};
}

bool RayCaster::blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = ray(from, to - from, 1);
  rtcOccluded1(scene_->scene, &context, &query);
  return query.tfar < 0;  // Embree's way to say so
}
}  // namespace ppf_bin_picking
