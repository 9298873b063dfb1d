#include "ppf_bin_picking/core/neighbor_search.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// nanoflann's view of the points.
struct PointsAdaptor
{
  const std::vector<Eigen::Vector3f>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const
  {
    return points[index][static_cast<int>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const
  {
    return false;
  }
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointsAdaptor>,
                                        PointsAdaptor, 3, std::uint32_t>;

/// Collects the indices of all points within a radius, border included.
class RadiusCollector
{
public:
  RadiusCollector(float squared_radius, std::vector<std::uint32_t>& indices)
      : worst_(std::nextafter(squared_radius, INFINITY)), indices_(indices)
  {
  }
  std::size_t size() const { return indices_.size(); }
  bool full() const { return true; }
  float worstDist() const { return worst_; }
  bool addPoint(float squared_distance, std::uint32_t index)
  {
    if (squared_distance < worst_) indices_.push_back(index);
    return true;
  }

private:
  float worst_;
  std::vector<std::uint32_t>& indices_;
};
}  // namespace

struct NeighborSearch::Tree
{
  explicit Tree(const std::vector<Eigen::Vector3f>& points)
      : adaptor{points}, index(3, adaptor, {10})
  {
    index.buildIndex();
  }
  PointsAdaptor adaptor;
  Index index;
};

NeighborSearch::NeighborSearch(const std::vector<Eigen::Vector3f>& points)
    : tree_(std::make_unique<Tree>(points))
{
}

NeighborSearch::~NeighborSearch() = default;

void NeighborSearch::within(const Eigen::Vector3f& query, float radius_m,
                            std::vector<std::uint32_t>& indices) const
{
  withinInAnyOrder(query, radius_m, indices);
  std::sort(indices.begin(), indices.end());
}

void NeighborSearch::withinInAnyOrder(const Eigen::Vector3f& query, float radius_m,
                                      std::vector<std::uint32_t>& indices) const
{
  indices.clear();
  if (tree_->adaptor.points.empty()) return;
  RadiusCollector collector(radius_m * radius_m, indices);
  tree_->index.findNeighbors(collector, query.data(), nanoflann::SearchParams());
}

void NeighborSearch::nearest(const Eigen::Vector3f& query, std::size_t count,
                             std::vector<std::pair<std::uint32_t, float>>& neighbors) const
{
  count = std::min(count, tree_->adaptor.points.size());
  thread_local std::vector<std::uint32_t> indices;
  thread_local std::vector<float> distances;
  indices.resize(count);
  distances.resize(count);
  const std::size_t found =
      tree_->index.knnSearch(query.data(), count, indices.data(), distances.data());
  neighbors.clear();
  for (std::size_t i = 0; i < found; ++i)
    neighbors.emplace_back(indices[i], distances[i]);
}
}  // namespace ppf_bin_picking
