#include "ppf_bin_picking/sim/bin.hpp"

#include <cstdint>

namespace ppf_bin_picking
{
TriangleMesh binMesh(const Bin& bin)
{
  TriangleMesh mesh;
  const auto add_box = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high)
  {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 8; ++corner)
      mesh.vertices.emplace_back(static_cast<float>((corner & 1) != 0 ? high.x() : low.x()),
                                 static_cast<float>((corner & 2) != 0 ? high.y() : low.y()),
                                 static_cast<float>((corner & 4) != 0 ? high.z() : low.z()));
    // Corners of each side, turning left as seen from outside.
    constexpr std::uint32_t kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : kSides)
    {
      mesh.triangles.push_back({first + s[0], first + s[1], first + s[2]});
      mesh.triangles.push_back({first + s[0], first + s[2], first + s[3]});
    }
  };
  const double x = bin.size_m.x() / 2, y = bin.size_m.y() / 2, z = bin.size_m.z(), w = bin.wall_m;
  add_box({-x - w, -y - w, -w}, {x + w, y + w, 0});
  add_box({-x - w, -y - w, 0}, {-x, y + w, z});
  add_box({x, -y - w, 0}, {x + w, y + w, z});
  add_box({-x, -y - w, 0}, {x, -y, z});
  add_box({-x, y, 0}, {x, y + w, z});
  return mesh;
}
}  // namespace ppf_bin_picking
