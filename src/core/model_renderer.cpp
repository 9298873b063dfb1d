#include "ppf_bin_picking/core/model_renderer.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNearest_m = 1e-3F;  // surfaces nearer to the camera than this are not drawn

/// A vertex in the image: pixel and 1/z, which is linear over the image of a plane. Behind the
/// camera: 0.
struct ImageVertex
{
  float u = 0;
  float v = 0;
  float inverse_z = 0;
};

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

/// Draws one triangle into the window's 1/z buffer, nearest surface wins.
void drawTriangle(const ImageVertex& a, const ImageVertex& b, const ImageVertex& c,
                  std::uint32_t index, RenderedPart& rendered)
{
  const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (area == 0) return;
  const int u0 = std::max(rendered.left, static_cast<int>(std::ceil(std::min({a.u, b.u, c.u}))));
  const int u1 = std::min(rendered.left + rendered.width - 1,
                          static_cast<int>(std::floor(std::max({a.u, b.u, c.u}))));
  const int v0 = std::max(rendered.top, static_cast<int>(std::ceil(std::min({a.v, b.v, c.v}))));
  const int v1 = std::min(rendered.top + rendered.height - 1,
                          static_cast<int>(std::floor(std::max({a.v, b.v, c.v}))));
  const float scale = 1.0F / area;
  for (int v = v0; v <= v1; ++v)
  {
    const float dv = static_cast<float>(v) - a.v;
    const std::size_t row = static_cast<std::size_t>(v - rendered.top) * rendered.width;
    for (int u = u0; u <= u1; ++u)
    {
      const float du = static_cast<float>(u) - a.u;
      const float weight_b = (du * (c.v - a.v) - dv * (c.u - a.u)) * scale;
      const float weight_c = (dv * (b.u - a.u) - du * (b.v - a.v)) * scale;
      const float weight_a = 1 - weight_b - weight_c;
      if (weight_a < 0 || weight_b < 0 || weight_c < 0) continue;
      const float inverse_z =
          weight_a * a.inverse_z + weight_b * b.inverse_z + weight_c * c.inverse_z;
      const std::size_t pixel = row + static_cast<std::size_t>(u - rendered.left);
      if (inverse_z <= rendered.depth[pixel]) continue;
      rendered.depth[pixel] = inverse_z;
      rendered.triangle[pixel] = index;
    }
  }
}
}  // namespace

void renderPart(const TriangleMesh& mesh, const Eigen::Isometry3f& T_camera_model,
                const PinholeCamera& camera, RenderedPart& rendered)
{
  thread_local std::vector<ImageVertex> vertices;
  transformVertices(mesh, T_camera_model, camera, vertices);
  placeWindow(vertices, camera, rendered);
  rendered.normals.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& [i0, i1, i2] = mesh.triangles[i];
    const Eigen::Vector3f& a = mesh.vertices[i0];
    rendered.normals[i] =
        T_camera_model.linear() * (mesh.vertices[i1] - a).cross(mesh.vertices[i2] - a).normalized();
    if (vertices[i0].inverse_z == 0 || vertices[i1].inverse_z == 0 || vertices[i2].inverse_z == 0)
      continue;
    drawTriangle(vertices[i0], vertices[i1], vertices[i2], static_cast<std::uint32_t>(i), rendered);
  }
  for (float& depth : rendered.depth)
    depth = depth > 0 ? 1.0F / depth : 0.0F;
}
}  // namespace ppf_bin_picking
