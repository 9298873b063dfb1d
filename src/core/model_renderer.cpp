#include "ppf_bin_picking/core/model_renderer.hpp"

#include "draw_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNearest_m = 1e-3F;  // surfaces nearer to the camera than this are not drawn

void transformVertices(const TriangleMesh& mesh, const Eigen::Isometry3f& T_camera_model,
                       const PinholeCamera& camera, std::vector<ImageVertex>& vertices)
{
  vertices.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const Eigen::Vector3f p = T_camera_model * mesh.vertices[i];
    if (!(p.z() > kNearest_m))
    {
      vertices[i] = ImageVertex();
      continue;
    }
    const Eigen::Vector2f pixel = camera.project(p);
    vertices[i] = {pixel.x(), pixel.y(), 1.0F / p.z()};
  }
}

/// Sets the window to the part's bounding box in the image.
void placeWindow(const std::vector<ImageVertex>& vertices, const PinholeCamera& camera,
                 RenderedPart& rendered)
{
  float u_min = static_cast<float>(camera.width), u_max = -1,
        v_min = static_cast<float>(camera.height), v_max = -1;
  for (const ImageVertex& vertex : vertices)
  {
    if (vertex.inverse_z == 0) continue;
    u_min = std::min(u_min, vertex.u);
    u_max = std::max(u_max, vertex.u);
    v_min = std::min(v_min, vertex.v);
    v_max = std::max(v_max, vertex.v);
  }
  rendered.left = static_cast<int>(std::max(0.0F, std::ceil(u_min)));
  rendered.top = static_cast<int>(std::max(0.0F, std::ceil(v_min)));
  const int right =
      static_cast<int>(std::min(static_cast<float>(camera.width - 1), std::floor(u_max)));
  const int bottom =
      static_cast<int>(std::min(static_cast<float>(camera.height - 1), std::floor(v_max)));
  const bool inside = right >= rendered.left && bottom >= rendered.top;
  rendered.width = inside ? right - rendered.left + 1 : 0;
  rendered.height = inside ? bottom - rendered.top + 1 : 0;
  const std::size_t pixels = static_cast<std::size_t>(rendered.width) * rendered.height;
  rendered.depth.assign(pixels, 0.0F);  // holds 1/z while drawing
  rendered.triangle.resize(pixels);
}
}  // namespace

RenderableMesh::RenderableMesh(const TriangleMesh& given) : mesh(given)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3f& a = mesh.vertices[triangle[0]];
    normals.push_back(
        (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).normalized());
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{triangle[k], triangle[(k + 1) % 3]}];
  }
  closed = std::all_of(edges.begin(), edges.end(),
                       [&](const auto& edge)
                       {
                         const auto back = edges.find({edge.first.second, edge.first.first});
                         return edge.second == 1 && back != edges.end() && back->second == 1;
                       });
}

void renderPart(const RenderableMesh& part, const Eigen::Isometry3f& T_camera_model,
                const PinholeCamera& camera, RenderedPart& rendered)
{
  std::vector<ImageVertex> vertices;
  transformVertices(part.mesh, T_camera_model, camera, vertices);
  placeWindow(vertices, camera, rendered);
  const DrawWindow window{rendered.left,   rendered.top,          rendered.width,
                          rendered.height, rendered.depth.data(), rendered.triangle.data()};
  rendered.normals.resize(part.normals.size());
  const Eigen::Matrix3f rotation = T_camera_model.linear();
  const Eigen::Vector3f camera_model = -(rotation.transpose() * T_camera_model.translation());
  for (std::size_t i = 0; i < part.normals.size(); ++i)
  {
    const auto& [i0, i1, i2] = part.mesh.triangles[i];
    if (part.closed && part.normals[i].dot(camera_model - part.mesh.vertices[i0]) <= 0) continue;
    rendered.normals[i] = rotation * part.normals[i];
    if (vertices[i0].inverse_z == 0 || vertices[i1].inverse_z == 0 || vertices[i2].inverse_z == 0)
      continue;
    drawTriangle(vertices[i0], vertices[i1], vertices[i2], static_cast<std::uint32_t>(i), window);
  }
  invertDepth(rendered.depth.data(), rendered.depth.size());
}
}  // namespace ppf_bin_picking
