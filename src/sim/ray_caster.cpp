#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ppf_bin_picking
{
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
  query.ray.org_x = origin.x();
  query.ray.org_y = origin.y();
  query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x();
  query.ray.dir_y = direction.y();
  query.ray.dir_z = direction.z();
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return RayHit{query.ray.tfar, query.hit.geomID, normal.normalized()};
}
}  // namespace ppf_bin_picking
