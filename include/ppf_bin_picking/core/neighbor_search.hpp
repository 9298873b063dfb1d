/// @file Radius and nearest-neighbour queries; the only place that knows the k-d tree.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// A k-d tree over points that outlive it. Queries are thread safe.
class NeighborSearch
{
public:
  /// @param points  Finite; kept by reference.
  explicit NeighborSearch(const std::vector<Eigen::Vector3f>& points);
  ~NeighborSearch();
  NeighborSearch(const NeighborSearch&) = delete;
  NeighborSearch& operator=(const NeighborSearch&) = delete;

  /// Indices of the points at most radius_m away, ascending.
  void within(const Eigen::Vector3f& query, float radius_m,
              std::vector<std::uint32_t>& indices) const;

  /// The same, in an order that means nothing: quicker, for sums of integers.
  void withinInAnyOrder(const Eigen::Vector3f& query, float radius_m,
                        std::vector<std::uint32_t>& indices) const;

  /// Indices and squared distances [m^2] of the nearest points, nearest first; fewer if there are
  /// fewer points.
  void nearest(const Eigen::Vector3f& query, std::size_t count,
               std::vector<std::pair<std::uint32_t, float>>& neighbors) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};
}  // namespace ppf_bin_picking
