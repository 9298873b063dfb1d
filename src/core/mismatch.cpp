#include "ppf_bin_picking/core/mismatch.hpp"

#include "ppf_bin_picking/core/pca.hpp"

#include <limits>

namespace ppf_bin_picking
{
std::vector<ClusterShare> shareClusters(const std::vector<PoseHypothesis>& distribution,
                                        const std::vector<Eigen::Vector3f>& centers,
                                        const std::vector<std::int32_t>& clusters)
{
  std::vector<std::vector<Eigen::Vector3f>> members(centers.size());
  for (const PoseHypothesis& hypothesis : distribution)
  {
    if (hypothesis.cluster < 0) continue;
    float nearest = std::numeric_limits<float>::max();
    std::size_t owner = centers.size();
    for (std::size_t i = 0; i < centers.size(); ++i)
    {
      if (clusters[i] != hypothesis.cluster) continue;
      const float distance = (centers[i] - hypothesis.center).squaredNorm();
      if (distance < nearest) nearest = distance, owner = i;
    }
    if (owner < centers.size()) members[owner].push_back(hypothesis.center);
  }
  std::vector<ClusterShare> shares;
  for (const std::vector<Eigen::Vector3f>& points : members)
    shares.push_back({principalBox(points), points.size()});
  return shares;
}
}  // namespace ppf_bin_picking
