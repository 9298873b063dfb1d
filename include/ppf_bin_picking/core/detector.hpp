/// @file The facade: one cloud in, trusted poses out.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/explanation.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include <atomic>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// Finds trained parts in one cloud. Thread safe: it keeps its settings and nothing between calls.
/// Unless a time limit cuts the search short, the same cloud and settings give the same bytes for
/// any number of threads.
class Detector
{
public:
  /// @throw std::invalid_argument listing every problem of the configuration.
  explicit Detector(DetectorConfig config);

  /// Finds one part.
  /// @param cloud_camera  Camera's optical frame, z forward, camera at the origin [m]; non-finite
  ///                      points are skipped.
  /// @param roi           Where to look, without walls, rim and table. Without it everywhere, and
  ///                      poses are less reliable: see assessReliability().
  /// @param stop          Set to true by another thread, ends the search as a time limit does.
  /// @return Poses, reliable ones first, the most reliable of all at the front. Finding none is a
  /// normal outcome, see its status.
  /// @throw std::invalid_argument if the model was trained with other parameters, or is larger than
  /// the
  ///        region of interest.
  DetectionResult detect(const PointCloud& cloud_camera, const PpfModel& model,
                         const std::optional<RegionOfInterest>& roi = std::nullopt,
                         const std::atomic<bool>* stop = nullptr) const;

  /// Finds several parts at once; they compete for the cloud, so that no surface is explained
  /// twice.
  /// @param models  Not null. Poses name them by index.
  DetectionResult detect(const PointCloud& cloud_camera, const std::vector<const PpfModel*>& models,
                         const std::optional<RegionOfInterest>& roi = std::nullopt,
                         const std::atomic<bool>* stop = nullptr) const;

  /// Detects one part and says what became of a given pose.
  /// @param T_cloud_model  The pose in question [m].
  /// @return Its status alone where no detection could be made.
  /// @throw std::invalid_argument as detect().
  PoseExplanation explain(const PointCloud& cloud_camera, const PpfModel& model,
                          const std::optional<RegionOfInterest>& roi,
                          const Eigen::Isometry3d& T_cloud_model) const;

  const DetectorConfig& config() const { return config_; }

private:
  DetectorConfig config_;
};

/// Checks that a model fits a configuration and a region. Empty: usable. Otherwise one sentence
/// that names the parameter, or the likely unit mistake, and the remedy.
std::string modelProblem(const PpfModel& model, const DetectorConfig& config,
                         const std::optional<RegionOfInterest>& roi);
}  // namespace ppf_bin_picking
