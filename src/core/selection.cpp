#include "ppf_bin_picking/core/selection.hpp"

#include "ppf_bin_picking/core/detector_config.hpp"

#include <cstdint>
#include <queue>

namespace ppf_bin_picking
{
namespace
{
struct Entry
{
  double balance;
  std::size_t candidate;
  std::size_t round;  ///< Number of poses taken when the balance was computed.

  bool operator<(const Entry& other) const
  {
    return balance != other.balance ? balance < other.balance : candidate > other.candidate;
  }
};

/// Weight of the confirmed pixels that nobody owns.
double freeWeight(const PoseEvidence& evidence, const std::vector<std::uint8_t>& owned)
{
  double free = 0;
  for (const PoseEvidence::Pixel& pixel : evidence.confirmed)
    if (!owned[pixel.index]) free += pixel.weight;
  return free;
}
}  // namespace

std::vector<SelectedPose> selectPoses(const std::vector<const PoseEvidence*>& candidates,
                                      std::size_t pixels)
{
  std::vector<std::uint8_t> owned(pixels, 0);
  std::priority_queue<Entry> queue;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    queue.push({evidenceBalance(*candidates[i], candidates[i]->confirmed_weight), i, 0});
  std::vector<SelectedPose> selected;
  while (!queue.empty())
  {
    const Entry best = queue.top();
    queue.pop();
    const PoseEvidence& evidence = *candidates[best.candidate];
    const double confirmed = freeWeight(evidence, owned);
    if (best.round <
        selected.size())  // balances only fall: one that is up to date and on top is the best
    {
      queue.push({evidenceBalance(evidence, confirmed), best.candidate, selected.size()});
      continue;
    }
    if (poseScore(evidence, confirmed) < kLeastScore) continue;
    selected.push_back({best.candidate, confirmed, best.balance});
    for (const PoseEvidence::Pixel& pixel : evidence.confirmed)
      owned[pixel.index] = 1;
  }
  return selected;
}
}  // namespace ppf_bin_picking
