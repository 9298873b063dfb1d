/// @file What a person would look at to tell a right pose from a wrong one, in numbers.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include <Eigen/Geometry>

#include <memory>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
class NeighborSearch;

/// A motion after which the part looks almost as before.
struct NearSymmetry
{
  std::string name;                                                 ///< Such as `end for end`.
  Eigen::Isometry3f T_model_model = Eigen::Isometry3f::Identity();  ///< About the part's centre.
};

/// Half turns about the part's principal axes; for a part of revolution the one end for end. Those
/// that the part's symmetries make true are left out.
std::vector<NearSymmetry> nearSymmetries(const PpfModel& model);

/// How one pose fits. Distances count up to a gate, so that neighbouring parts do not matter.
struct PoseCheck
{
  double rmse_m = 0;  ///< Of the visible surface against the cloud, where that does not lie behind.
  double both_ways_m = 0;  ///< RMSE with the cloud in front of the part against its surface, too.
  double turned_m = -1;    ///< The same for the best near-symmetry, after refitting; -1: none.
  std::string turn;        ///< Its name.
  /// Share of the visible surface that the cloud lies behind, without a ring along the outline of
  /// 0.05 diameters, where sensors lose and smear surfaces.
  double looked_through = 0;
  double overlap = 0;     ///< Share of the surface inside another pose's part.
  int overlap_with = -1;  ///< That pose in the list; -1: none.
  std::string verdict;    ///< `ok`, or what is suspicious.
};

/// Compares poses of one part with one depth image.
class PoseChecker
{
public:
  /// @param image, model, config  Outlive the checker.
  PoseChecker(const RangeImage& image, const PpfModel& model, const DetectorConfig& config);
  ~PoseChecker();
  PoseChecker(const PoseChecker&) = delete;
  PoseChecker& operator=(const PoseChecker&) = delete;

  /// @param poses  T_camera_model; each is also compared with the others.
  std::vector<PoseCheck> check(const std::vector<Eigen::Isometry3f>& poses) const;

private:
  struct Fit;
  Fit fitOf(const Eigen::Isometry3f& pose) const;
  double bothWays(const Fit& fit, const std::vector<std::uint32_t>& claimed) const;
  double distanceToModel(const Eigen::Vector3f& point_model) const;
  double overlapOf(const Eigen::Isometry3f& pose, const Eigen::Isometry3f& other) const;
  void addVerdict(PoseCheck& check) const;

  const RangeImage& image_;
  const PpfModel& model_;
  const DetectorConfig& config_;
  float gate_m_;  ///< Farther away is another surface.
  std::vector<NearSymmetry> near_symmetries_;
  OrientedPoints surface_;              ///< Dense, mesh frame.
  std::vector<Eigen::Vector3f> scene_;  ///< The image's points.
  std::unique_ptr<NeighborSearch> surface_search_;
  std::unique_ptr<NeighborSearch> scene_search_;
};
}  // namespace ppf_bin_picking
