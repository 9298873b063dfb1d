#include "peers.hpp"

#include <pcl/console/print.h>
#include <pcl/features/ppf.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/ppf_registration.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
using Cloud = pcl::PointCloud<pcl::PointNormal>;

Cloud::Ptr cloudOf(const OrientedPoints& points)
{
  Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pcl::PointNormal point;
    point.getVector3fMap() = points.points[i];
    point.getNormalVector3fMap() = points.normals[i];
    cloud->push_back(point);
  }
  return cloud;
}

/// PCL's own thinning, which averages the normals as well.
Cloud::Ptr thinnedOut(const OrientedPoints& points, double cell_m)
{
  pcl::VoxelGrid<pcl::PointNormal> grid;
  grid.setInputCloud(cloudOf(points));
  const auto leaf_m = static_cast<float>(cell_m);
  grid.setLeafSize(leaf_m, leaf_m, leaf_m);
  Cloud::Ptr thinned(new Cloud);
  grid.filter(*thinned);
  for (pcl::PointNormal& point : *thinned)
    point.getNormalVector3fMap().normalize();
  return thinned;
}

/// 12 degrees less one step of float: with 12 degrees themselves PCL 1.13 writes past its
/// accumulator.
float angleStep()
{
  return std::nextafter(12.0F / 180.0F * static_cast<float>(M_PI), 0.0F);
}

class PclPeer : public Peer
{
public:
  void train(const ToolPart& part) override
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    const PeerPart made = peerPart(part);
    diameter_m_ = made.diameter_m;
    model_ = thinnedOut(made.surface, kStepRel * diameter_m_);
    pcl::PPFEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PPFSignature> estimation;
    estimation.setInputCloud(model_);
    estimation.setInputNormals(model_);
    const pcl::PointCloud<pcl::PPFSignature>::Ptr features(new pcl::PointCloud<pcl::PPFSignature>);
    estimation.compute(*features);
    search_ =
        pcl::PPFHashMapSearch(angleStep(), static_cast<float>(kStepRel * diameter_m_)).makeShared();
    search_->setInputFeatureCloud(features);
  }

  PeerResult detect(const PeerScene& scene) override
  {
    PeerResult peer;
    Cloud::Ptr target;
    timeStage(
        "sampling", [&] { target = thinnedOut(scene.voxels, kStepRel * diameter_m_); }, peer);
    pcl::PPFRegistration<pcl::PointNormal, pcl::PointNormal> registration;
    registration.setSceneReferencePointSamplingRate(kReferenceStride);
    registration.setPositionClusteringThreshold(static_cast<float>(kGroupRel * diameter_m_));
    registration.setRotationClusteringThreshold(kGroup_rad);
    registration.setSearchMethod(search_);
    registration.setInputSource(model_);
    registration.setInputTarget(target);
    Cloud aligned;
    timeStage(
        "align", [&] { registration.align(aligned); }, peer);
    DetectedPose pose;
    pose.T_cloud_model.matrix() = registration.getFinalTransformation().cast<double>();
    pose.score = 1;  // PCL keeps the votes to itself
    pose.reliable = true;
    peer.result.poses = {pose};
    peer.points = target->size();
    return peer;
  }

private:
  double diameter_m_ = 0;
  Cloud::Ptr model_;
  pcl::PPFHashMapSearch::Ptr search_;
};
}  // namespace

std::unique_ptr<Peer> pclPeer()
{
  return std::make_unique<PclPeer>();
}
}  // namespace ppf_bin_picking
