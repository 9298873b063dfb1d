#include "ppf_bin_picking/core/detector.hpp"

#include "peers.hpp"

#include <algorithm>
#include <optional>

namespace ppf_bin_picking
{
namespace
{
class OwnPeer : public Peer
{
public:
  explicit OwnPeer(int repeat) : repeat_(repeat) {}
  bool wantsVoxels() const override { return false; }

  void train(const ToolPart& part) override
  {
    config_ = part.config;
    model_ = trainedModel(part);
  }

  PeerResult detect(const PeerScene& scene) override
  {
    const Detector detector(config_);
    std::vector<DetectionResult> results;
    PeerResult peer;
    for (int i = 0; i < repeat_; ++i)
    {
      timeStage(
          "run", [&] { results.push_back(detector.detect(scene.cloud, *model_, scene.region)); },
          peer);
    }
    peer.runs = peer.result.stages;
    const auto middle = results.begin() + static_cast<std::ptrdiff_t>(results.size() / 2);
    std::nth_element(results.begin(), middle, results.end(),
                     [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    peer.result = *middle;
    peer.points = peer.result.scene_points.size();
    return peer;
  }

private:
  int repeat_;
  DetectorConfig config_;
  std::optional<PpfModel> model_;
};
}  // namespace

std::unique_ptr<Peer> ownPeer(int repeat)
{
  return std::make_unique<OwnPeer>(repeat);
}
}  // namespace ppf_bin_picking
