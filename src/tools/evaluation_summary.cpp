#include "evaluation_summary.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMillimetres = 1000.0;
constexpr double kDegrees = 180.0 / M_PI;

double share(double part, double whole)
{
  return whole > 0 ? part / whole : kNoValue;
}

/// The middle value, or the mean of the middle two.
double median(std::vector<double> values)
{
  if (values.empty()) return kNoValue;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

bool isOnAnObject(const JudgedPose& pose)
{
  return pose.verdict == Verdict::kRight || pose.verdict == Verdict::kIgnored;
}

/// How many poses have each verdict.
struct Counts
{
  explicit Counts(const std::vector<JudgedPose>& poses) : all(poses.size())
  {
    for (const JudgedPose& pose : poses)
    {
      if (pose.verdict == Verdict::kRight) ++right;
      if (pose.verdict == Verdict::kWrong) ++wrong;
      if (pose.verdict == Verdict::kDuplicate) ++duplicates;
    }
  }

  std::size_t all = 0;
  std::size_t right = 0;
  std::size_t wrong = 0;
  std::size_t duplicates = 0;
};

double count(std::size_t number)
{
  return static_cast<double>(number);
}

/// What the scenes say one by one: first poses, times, recalled targets.
void addScenes(const std::vector<JudgedScene>& scenes, Summary& summary)
{
  std::size_t first_on_object = 0;
  std::vector<double> times;
  RecalledTargets recalled;
  for (const JudgedScene& scene : scenes)
  {
    const auto first = std::find_if(scene.poses.begin(), scene.poses.end(),
                                    [](const JudgedPose& pose) { return pose.reliable; });
    if (first != scene.poses.end() && isOnAnObject(*first)) ++first_on_object;
    if (std::isfinite(scene.time_ms)) times.push_back(scene.time_ms);
    recalled.vsd += scene.recalled.vsd;
    recalled.mssd += scene.recalled.mssd;
    recalled.mspd += scene.recalled.mspd;
  }
  summary.first = share(count(first_on_object), count(scenes.size()));
  summary.median_ms = median(times);
  summary.largest_ms = times.empty() ? kNoValue : *std::max_element(times.begin(), times.end());
  summary.recall_vsd = share(recalled.vsd, count(summary.targets));
  summary.recall_mssd = share(recalled.mssd, count(summary.targets));
  summary.recall_mspd = share(recalled.mspd, count(summary.targets));
}

/// What the poses say, of whatever scene.
void addPoses(const std::vector<JudgedPose>& poses, Summary& summary)
{
  std::vector<JudgedPose> reliable;
  std::vector<JudgedPose> flagged;
  std::vector<double> translations;
  std::vector<double> rotations;
  std::vector<double> nees;
  for (const JudgedPose& pose : poses)
  {
    (pose.reliable ? reliable : flagged).push_back(pose);
    if (!pose.reliable || pose.verdict != Verdict::kRight) continue;
    translations.push_back(pose.translation_m * kMillimetres);
    rotations.push_back(pose.rotation_rad * kDegrees);
    if (!std::isnan(pose.nees)) nees.push_back(pose.nees);
  }
  const Counts given(reliable);
  const Counts held(flagged);
  summary.right = given.right;
  summary.wrong = given.wrong + given.duplicates;
  summary.curve = precisionRecall(poses, summary.targets);
  summary.average_precision = averagePrecision(summary.curve);
  summary.average_precision_reliable = averagePrecision(precisionRecall(reliable, summary.targets));
  summary.precision = share(count(summary.right), count(summary.right + summary.wrong));
  summary.recall = share(count(summary.right), count(summary.targets));
  summary.flag_precision = share(count(held.wrong), count(held.all));
  summary.flag_recall = share(count(held.wrong), count(held.wrong + given.wrong));
  summary.lost = share(count(held.right), count(held.right + given.right));
  summary.translation_mm = median(translations);
  summary.rotation_deg = median(rotations);
  summary.nees = median(nees);
}
}  // namespace

std::vector<CurvePoint> precisionRecall(std::vector<JudgedPose> poses, std::size_t targets)
{
  std::stable_sort(poses.begin(), poses.end(),
                   [](const JudgedPose& a, const JudgedPose& b) { return a.score > b.score; });
  std::vector<CurvePoint> curve;
  std::size_t right = 0;
  for (const JudgedPose& pose : poses)
  {
    if (pose.verdict == Verdict::kIgnored) continue;
    if (pose.verdict == Verdict::kRight) ++right;
    curve.push_back({pose.score, count(right) / count(curve.size() + 1),
                     targets == 0 ? 0.0 : count(right) / count(targets)});
  }
  return curve;
}

double averagePrecision(const std::vector<CurvePoint>& curve)
{
  double area = 0;
  double best = 0;
  for (std::size_t i = curve.size(); i-- > 0;)
  {
    best = std::max(best, curve[i].precision);
    area += best * (curve[i].recall - (i == 0 ? 0.0 : curve[i - 1].recall));
  }
  return area;
}

Summary summarise(const std::vector<JudgedScene>& scenes)
{
  Summary summary;
  summary.scenes = scenes.size();
  std::vector<JudgedPose> poses;
  for (const JudgedScene& scene : scenes)
  {
    summary.targets += scene.targets;
    poses.insert(poses.end(), scene.poses.begin(), scene.poses.end());
  }
  addScenes(scenes, summary);
  addPoses(poses, summary);
  return summary;
}
}  // namespace ppf_bin_picking
