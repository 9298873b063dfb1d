#include "ppf_bin_picking/core/dbscan.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"

namespace ppf_bin_picking
{
std::vector<std::int32_t> dbscan(const std::vector<Eigen::Vector3f>& points, float eps_m,
                                 std::size_t minpts)
{
  const NeighborSearch search(points);
  std::vector<std::int32_t> labels(points.size(), kNoise);
  std::vector<std::uint8_t> visited(points.size(), 0);
  std::vector<std::uint32_t> near, frontier;
  std::int32_t cluster = 0;
  const auto expand_core_point = [&]
  {
    for (const std::uint32_t neighbor : near)
    {
      if (labels[neighbor] == kNoise) labels[neighbor] = cluster;
      if (visited[neighbor]) continue;
      visited[neighbor] = 1;
      frontier.push_back(neighbor);
    }
  };
  for (std::uint32_t seed = 0; seed < points.size(); ++seed)
  {
    if (visited[seed]) continue;
    search.within(points[seed], eps_m, near);
    if (near.size() < minpts) continue;  // noise, unless a core point found later reaches it
    expand_core_point();
    while (!frontier.empty())
    {
      const std::uint32_t point = frontier.back();
      frontier.pop_back();
      search.within(points[point], eps_m, near);
      if (near.size() >= minpts) expand_core_point();
    }
    ++cluster;
  }
  return labels;
}
}  // namespace ppf_bin_picking
