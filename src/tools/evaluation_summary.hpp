/// @file What judged scenes say about a detector.
#pragma once

#include "bop_recall.hpp"
#include "pose_judgement.hpp"

#include <limits>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// One scene with what was found in it.
struct JudgedScene
{
  std::string name;
  std::size_t targets = 0;
  double time_ms = kNoValue;      ///< Of the detection; NaN: no result.
  std::vector<JudgedPose> poses;  ///< Best score first.
  RecalledTargets recalled;       ///< By the reliable poses.
};

/// Precision and recall when all poses down to a score are taken.
struct CurvePoint
{
  double score = 0;
  double precision = 0;
  double recall = 0;
};

/// The precision-recall curve, a point a pose that counts, best score first; poses of equal score
/// stay in the given order.
/// @param targets  Objects to be found; the recall is 0 where there are none.
std::vector<CurvePoint> precisionRecall(std::vector<JudgedPose> poses, std::size_t targets);

/// The area under the curve, whose precision at a recall is the best at this recall or a higher
/// one.
double averagePrecision(const std::vector<CurvePoint>& curve);

/// Figures of one part, or of all. A share or a median of nothing is NaN.
struct Summary
{
  std::size_t scenes = 0;
  std::size_t targets = 0;
  std::size_t right = 0;                  ///< Reliable poses that are right.
  std::size_t wrong = 0;                  ///< Reliable poses that are wrong or duplicates.
  double average_precision = 0;           ///< Of all poses, reliable or not.
  double precision = 0;                   ///< Of the reliable poses.
  double recall = 0;                      ///< Of the reliable poses.
  double average_precision_reliable = 0;  ///< Of the reliable poses alone.
  double first = 0;           ///< Share of scenes whose best reliable pose is on an object.
  double flag_precision = 0;  ///< Of the unreliable poses, how many are wrong (no duplicates).
  double flag_recall = 0;     ///< Of the wrong poses, how many are unreliable.
  double lost = 0;            ///< Of the right poses, how many are unreliable.
  double translation_mm = 0;  ///< Median of the right reliable poses.
  double rotation_deg = 0;    ///< Median of the right reliable poses.
  double nees = 0;            ///< Median of the right reliable poses with a covariance.
  double median_ms = 0;
  double largest_ms = 0;
  double recall_vsd = 0;   ///< AR_VSD of the reliable poses.
  double recall_mssd = 0;  ///< AR_MSSD of the reliable poses.
  double recall_mspd = 0;  ///< AR_MSPD of the reliable poses.

  std::vector<CurvePoint> curve;  ///< Of all poses.
};

/// Sums up scenes.
Summary summarise(const std::vector<JudgedScene>& scenes);
}  // namespace ppf_bin_picking
