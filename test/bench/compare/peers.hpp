/// @file The detectors that are compared, behind one interface.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "tool_support.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
constexpr double kVoxelRel = 0.02;    // of the points that the peers are given, in diameters
constexpr double kStepRel = 0.05;     // of the peers' sampling and distance bins, in diameters
constexpr int kReferenceStride = 5;   // of the peers' scene points, every so manieth is a reference
constexpr double kGroupRel = 0.1;     // the peers' poses nearer than this are one, in diameters
constexpr float kGroup_rad = 0.349F;  // ... and turned by less than this

/// A part as the peers are given it.
struct PeerPart
{
  double diameter_m = 0;
  OrientedPoints surface;  ///< At a spacing of kVoxelRel, mesh frame [m].
};

/// The same for a scene.
struct PeerScene
{
  PointCloud cloud;  ///< As the camera gives it [m].
  RegionOfInterest region;
  OrientedPoints voxels;  ///< Of the region, normals towards the camera; empty for those that start
                          ///< from the cloud.
};

/// What a peer found, and how.
struct PeerResult
{
  DetectionResult result;
  std::vector<StageTime> runs;  ///< Of a repeated detection, each whole one, in order.
  double cores = 0;             ///< Seconds of the processor in each second of the detection.
  std::size_t points = 0;       ///< Of the scene, as sampled.
  double peak_mb = 0;           ///< Of the process with cloud and model, at most so far [MB].
};

class Peer
{
public:
  virtual ~Peer() = default;
  virtual bool wantsVoxels() const { return true; }
  /// Starts no thread.
  virtual void train(const ToolPart& part) = 0;
  virtual PeerResult detect(const PeerScene& scene) = 0;
};

/// This package's detector. The result is that of the run with the median time.
/// @param repeat  Detections of a scene.
std::unique_ptr<Peer> ownPeer(int repeat);

/// PCL's PPFRegistration, which gives one pose a scene.
std::unique_ptr<Peer> pclPeer();

/// OpenCV's PPF3DDetector with its ICP.
/// @param scene_step  Its sampling of the scene, relative to the scene's extent.
std::unique_ptr<Peer> opencvPeer(double scene_step);

/// Surface samples and diameter of a part.
PeerPart peerPart(const ToolPart& part);

/// Runs one stage of a peer and notes its time.
void timeStage(const char* name, const std::function<void()>& stage, PeerResult& peer);

/// Versions and build of what is compared, as JSON.
std::string buildFacts();
}  // namespace ppf_bin_picking
