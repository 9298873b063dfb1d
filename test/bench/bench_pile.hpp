/// @file The fixed input of the micro-benchmarks: a pile of one of the package's parts, as a camera
/// sees it, and what each stage makes of it for the next.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// A part of config/parts, trained at a step of 0.05 diameters.
struct BenchPart
{
  explicit BenchPart(const std::string& name);

  DetectorConfig config;  ///< The defaults, but for the step and a single thread.
  TriangleMesh mesh;      ///< [m]
  SymmetryGroup symmetries;
  PpfModel model;
};

/// 24 parts at random orientations over a floor, seen from above through 640 x 480 pixels with
/// noise. The floor lies outside the region of interest. The same part gives the same pile.
struct BenchPile
{
  explicit BenchPile(const BenchPart& part);

  RegionOfInterest region;                   ///< Camera frame [m].
  PointCloud cloud;                          ///< Camera frame [m].
  RangeImage image;                          ///< Of cloud.
  OrientedPoints scene;                      ///< Of image, at the model's step [m].
  std::vector<PoseHypothesis> hypotheses;    ///< High-vote ones of scene.
  std::vector<Eigen::Isometry3f> true_T;     ///< T_camera_model of each part [m].
  std::vector<Eigen::Isometry3f> shifted_T;  ///< As true_T, off by 0.03 diameters and 5 degrees.
};

/// As the detector makes the image.
RangeImageOptions imageOptions(const BenchPart& part);

/// What matchModel() has to do.
struct VoteCount
{
  std::size_t pairs =
      0;  ///< Of a reference point and a scene point no farther off than the diameter.
  std::size_t votes = 0;  ///< Entries of the table under the keys of these pairs.
};
VoteCount countVotes(const OrientedPoints& scene, const PpfModel& model,
                     const DetectorConfig& config);

/// Pixels that the parts cover, each drawn alone.
std::size_t countPixels(const RangeImage& image, const PpfModel& model,
                        const std::vector<Eigen::Isometry3f>& poses);
}  // namespace ppf_bin_picking
