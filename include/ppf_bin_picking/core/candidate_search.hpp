/// @file From the range image to candidates: sampling, voting, clustering.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/parallel.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <vector>

namespace ppf_bin_picking
{
/// A pose on its way to the answer.
struct Candidate
{
  std::uint32_t model = 0;
  std::int32_t cluster = -1;  ///< Index into the result's clusters.
  float votes = 0;
  Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();  ///< Mesh frame [m].
  bool verified = false;  ///< False if the time limit came first; the evidence is empty then.
  PoseEvidence evidence;
  /// What seenBalance() gained by a climb, see climbStanding(). Rivals that do not stand do not
  /// climb, so it is no part of a lead.
  double climbed = 0;
};

/// Whether two candidates are of one model and their poses nearer than a distance of the centres,
/// in diameters, and an angle [rad], over the part's symmetries.
/// @param model  Of the first.
bool areNear(const Candidate& a, const Candidate& b, const PpfModel& model, double distance_rel,
             double angle_rad);

/// The measured points of the region with normals, thinned out to a model's sampling step.
OrientedPoints sampleScene(const RangeImage& image, float step_m);

/// What pairs of boundary points of the image vote for.
std::vector<PoseHypothesis> boundaryHypotheses(const RangeImage& image, const PpfModel& model,
                                               const DetectorConfig& config,
                                               const Deadline& deadline);

/// Votes for one model, clusters the hypotheses and chooses the groups worth a closer look. Appends
/// the distribution and the clusters to the result, and the candidates, most votes first.
/// @param lap  Called with the name of each stage at its end.
void searchCandidates(const RangeImage& image, const PpfModel& model, std::uint32_t model_index,
                      const DetectorConfig& config, const Deadline& deadline,
                      const std::function<void(const char*)>& lap, DetectionResult& result,
                      std::vector<Candidate>& candidates);
}  // namespace ppf_bin_picking
