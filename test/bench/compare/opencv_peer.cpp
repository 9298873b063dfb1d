#include "peers.hpp"

#include <opencv2/surface_matching.hpp>

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
namespace ppf = cv::ppf_match_3d;

constexpr double kAngleSteps = 30;
constexpr std::size_t kRefined = 30;  // poses that go through ICP: about as many as a bin has parts
// As in OpenCV's own example.
constexpr int kIcpIterations = 100;
constexpr float kIcpTolerance = 0.005F;
constexpr float kIcpRejection = 2.5F;
constexpr int kIcpLevels = 8;

/// A point and its normal in each row.
cv::Mat matrixOf(const OrientedPoints& points)
{
  cv::Mat matrix(static_cast<int>(points.size()), 6, CV_32F);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    auto* row = matrix.ptr<float>(static_cast<int>(i));
    std::copy_n(points.points[i].data(), 3, row);
    std::copy_n(points.normals[i].data(), 3, row + 3);
  }
  return matrix;
}

DetectedPose poseOf(const ppf::Pose3D& found)
{
  DetectedPose pose;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      pose.T_cloud_model.matrix()(row, column) = found.pose(row, column);
  pose.score = pose.votes = static_cast<double>(found.numVotes);
  pose.reliable = true;
  return pose;
}

class OpencvPeer : public Peer
{
public:
  explicit OpencvPeer(double scene_step) : scene_step_(scene_step) {}

  void train(const ToolPart& part) override
  {
    const PeerPart made = peerPart(part);
    model_ = matrixOf(made.surface);
    detector_.setSearchParams(kGroupRel * made.diameter_m, kGroup_rad);
    detector_.trainModel(model_);
  }

  PeerResult detect(const PeerScene& scene) override
  {
    PeerResult peer;
    const cv::Mat points = matrixOf(scene.voxels);
    std::vector<ppf::Pose3DPtr> found;
    timeStage(
        "match", [&] { detector_.match(points, found, 1.0 / kReferenceStride, scene_step_); },
        peer);
    found.resize(std::min(found.size(), kRefined));
    ppf::ICP icp(kIcpIterations, kIcpTolerance, kIcpRejection, kIcpLevels);
    timeStage(
        "ICP", [&] { icp.registerModelToScene(model_, points, found); }, peer);
    for (const ppf::Pose3DPtr& pose : found)
      peer.result.poses.push_back(poseOf(*pose));
    peer.points = scene.voxels.size();
    return peer;
  }

private:
  double scene_step_;
  cv::Mat model_;
  ppf::PPF3DDetector detector_{kStepRel, kStepRel, kAngleSteps};
};
}  // namespace

std::unique_ptr<Peer> opencvPeer(double scene_step)
{
  return std::make_unique<OpencvPeer>(scene_step);
}
}  // namespace ppf_bin_picking
