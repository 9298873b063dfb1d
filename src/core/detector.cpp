#include "ppf_bin_picking/core/detector.hpp"

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/candidate_verification.hpp"
#include "ppf_bin_picking/core/detection_message.hpp"
#include "ppf_bin_picking/core/parallel.hpp"
#include "ppf_bin_picking/core/pose_report.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/selection.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMaxDiameterPerDepth = 2;    // a larger part fits into no image: a wrong unit
constexpr double kMinPixelsPerDiameter = 20;  // below, chance fits look like parts

/// Measures the stages one after the other.
class StageClock
{
public:
  /// Ends the stage that ran until now.
  void lap(const std::string& name, std::vector<StageTime>& stages)
  {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    const auto known = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageTime& stage) { return stage.name == name; });
    if (known == stages.end())
      stages.push_back({name, seconds});
    else
      known->seconds += seconds;
    last_ = now;
  }
  double total() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

std::string cloudProblem(const PointCloud& cloud, const DetectorConfig& config)
{
  std::ostringstream text;
  if (cloud.size() == 0)
    text << "the cloud has no points: check that the camera is running";
  else if (cloud.width * cloud.height != cloud.size())
    text << "the cloud has " << cloud.size() << " points but says " << cloud.width << " x "
         << cloud.height << ": mend its width and height";
  else if (cloud.size() > static_cast<std::size_t>(config.max_points))
    text << "the cloud has " << cloud.size() << " points, more than max_points ("
         << config.max_points << "): thin it out, crop it, or raise max_points";
  else if (!cloud.normals.empty() && cloud.normals.size() != cloud.size())
    text << "the cloud has " << cloud.normals.size() << " normals for " << cloud.size()
         << " points: give one for each or none";
  else if (config.use_cloud_normals && cloud.normals.empty())
    text << "the cloud has no normals but use_cloud_normals is set: unset it or send normals";
  else if (std::none_of(cloud.points.begin(), cloud.points.end(), measured))
    text << "none of the cloud's " << cloud.size() << " points is measured (all are NaN, infinite, "
         << "zero, or not before the camera): check the camera's view and exposure, and that z "
         << "points forward";
  return text.str();
}

RangeImageOptions imageOptions(const DetectorConfig& config,
                               const std::vector<const PpfModel*>& models)
{
  const auto smaller = [](const PpfModel* a, const PpfModel* b)
  { return a->diameter() < b->diameter(); };
  const auto [smallest, largest] = std::minmax_element(models.begin(), models.end(), smaller);
  return {(*smallest)->diameter(), (*largest)->diameter(),   config.pixels_per_diameter,
          config.normal_radius_px, config.use_cloud_normals, config.threads};
}

void setStatus(DetectionResult& result, bool cut_short, double time_limit_s)
{
  const std::size_t reliable = reliablePoses(result);
  if (!cut_short)
  {
    result.status = reliable > 0 ? DetectionStatus::kOk : DetectionStatus::kNoPickablePose;
    result.message = searchMessage(result);
    return;
  }
  result.status = DetectionStatus::kTimeLimit;
  std::ostringstream text;
  if (time_limit_s > 0)
    text << "the time limit of " << time_limit_s << " s ended the search with "
         << reliablePosesInWords(reliable) << ": raise time_limit_s to see all";
  else
    text << "the search was stopped with " << reliablePosesInWords(reliable);
  result.message = text.str();
}

/// What keeps the image from showing the parts. Empty: nothing.
std::string imageProblem(const RangeImageResult& prepared,
                         const std::vector<const PpfModel*>& models)
{
  std::ostringstream text;
  text.precision(3);
  double largest_m = 0;
  for (const PpfModel* model : models)
    largest_m = std::max(largest_m, model->diameter());
  if (largest_m > kMaxDiameterPerDepth * prepared.near_z_m)
    text << "the part is " << largest_m << " m long but the cloud begins " << prepared.near_z_m
         << " m before the camera: the mesh's unit or the cloud's is probably wrong (m for mm)";
  else if (prepared.pixels_per_diameter < kMinPixelsPerDiameter)
    text << "the part measures only " << prepared.pixels_per_diameter
         << " pixels across in this cloud and needs " << kMinPixelsPerDiameter
         << ": mend the unit if the cloud is not in metres, or take a finer or nearer camera";
  return text.str();
}

/// What a detection works on.
struct Work
{
  RangeImageResult prepared;
  std::vector<Candidate> candidates;
  std::vector<SelectedPose> selected;
};

/// Looks at what the standing poses may be confused with as well, and chooses anew.
void addLookAlikes(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                   const Deadline& deadline, const std::function<void(const char*)>& lap,
                   Work& work)
{
  const RangeImage& image = work.prepared.image;
  std::vector<Candidate> turned = lookAlikesOf(models, config, work.candidates, work.selected);
  if (turned.empty()) return;
  verifyCandidates(image, models, config, deadline, lap, turned);
  std::move(turned.begin(), turned.end(), std::back_inserter(work.candidates));
  work.selected = selectCandidates(work.candidates, image.depth.size());
}

/// Lets standing poses climb, and chooses anew. False if the deadline kept one from it.
bool climb(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
           const Deadline& deadline, const std::function<void(const char*)>& lap, Work& work)
{
  const RangeImage& image = work.prepared.image;
  const bool all = climbStanding(image, models, config, deadline, work.selected, work.candidates);
  work.selected = selectCandidates(work.candidates, image.depth.size());
  lap("climbing");
  return all;
}

/// From a cloud that can be worked on to the poses.
void search(const PointCloud& cloud_camera, const std::vector<const PpfModel*>& models,
            const DetectorConfig& config, const std::optional<RegionOfInterest>& roi,
            const Deadline& deadline, StageClock& clock, Work& work, DetectionResult& result)
{
  const RangeImageResult& prepared = work.prepared =
      makeRangeImage(cloud_camera, roi, imageOptions(config, models));
  const RangeImage& image = prepared.image;
  result.roi_points = prepared.roi_points;
  result.noise_m = image.noise_m;
  const auto lap = [&](const char* stage) { clock.lap(stage, result.stages); };
  lap("preparation");
  if (prepared.roi_points == 0)
  {
    result.status = DetectionStatus::kRoiEmpty;
    result.message = emptyRegionMessage(cloud_camera, *roi);
    return;
  }
  result.message = imageProblem(prepared, models);
  if (!result.message.empty())
  {
    result.status = DetectionStatus::kBadCloud;
    return;
  }
  std::vector<Candidate>& candidates = work.candidates;
  for (std::uint32_t i = 0; i < models.size(); ++i)
    searchCandidates(image, *models[i], i, config, deadline, lap, result, candidates);
  verifyCandidates(image, models, config, deadline, lap, candidates);
  work.selected = selectCandidates(candidates, image.depth.size());
  lap("selection");
  addLookAlikes(models, config, deadline, lap, work);
  bool cut_short = deadline.passed();
  if (config.climb) cut_short = !climb(models, config, deadline, lap, work) || cut_short;
  reportPoses(models, config, candidates, work.selected, image, result);
  lap("selection");
  setStatus(result, cut_short, config.time_limit_s);
}

/// A whole detection.
DetectionResult detected(const PointCloud& cloud_camera, const std::vector<const PpfModel*>& models,
                         const DetectorConfig& config, const std::optional<RegionOfInterest>& roi,
                         const std::atomic<bool>* stop, Work& work)
{
  if (models.empty()) throw std::invalid_argument("no model to look for: give at least one");
  for (const PpfModel* model : models)
  {
    const std::string problem = modelProblem(*model, config, roi);
    if (!problem.empty()) throw std::invalid_argument(problem);
  }
  StageClock clock;
  const Deadline deadline(config.time_limit_s, stop);
  DetectionResult result;
  result.message = cloudProblem(cloud_camera, config);
  if (!result.message.empty())
    result.status = DetectionStatus::kBadCloud;
  else
    search(cloud_camera, models, config, roi, deadline, clock, work, result);
  result.seconds = clock.total();
  return result;
}
}  // namespace

std::string modelProblem(const PpfModel& model, const DetectorConfig& config,
                         const std::optional<RegionOfInterest>& roi)
{
  std::ostringstream text;
  const ModelParameters& trained = model.parameters();
  if (!(trained == config.model))
    text << "the model was trained with step_rel " << trained.step_rel << " and n_angle "
         << trained.n_angle << " but the configuration says " << config.model.step_rel << " and "
         << config.model.n_angle << ": train it again or mend the configuration";
  else if (roi && model.diameter() > roi->diagonal())
    text << "the part is " << model.diameter()
         << " m long but the region of interest measures only " << roi->diagonal()
         << " m across: the mesh's unit is probably wrong (m for mm), or the region's numbers are";
  return text.str();
}

Detector::Detector(DetectorConfig config) : config_(config)
{
  std::string text;
  for (const std::string& problem : config_.problems())
    text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
}

DetectionResult Detector::detect(const PointCloud& cloud_camera, const PpfModel& model,
                                 const std::optional<RegionOfInterest>& roi,
                                 const std::atomic<bool>* stop) const
{
  return detect(cloud_camera, std::vector<const PpfModel*>{&model}, roi, stop);
}

DetectionResult Detector::detect(const PointCloud& cloud_camera,
                                 const std::vector<const PpfModel*>& models,
                                 const std::optional<RegionOfInterest>& roi,
                                 const std::atomic<bool>* stop) const
{
  Work work;
  return detected(cloud_camera, models, config_, roi, stop, work);
}

PoseExplanation Detector::explain(const PointCloud& cloud_camera, const PpfModel& model,
                                  const std::optional<RegionOfInterest>& roi,
                                  const Eigen::Isometry3d& T_cloud_model) const
{
  Work work;
  DetectionResult result = detected(cloud_camera, {&model}, config_, roi, nullptr, work);
  if (result.status == DetectionStatus::kRoiEmpty || result.status == DetectionStatus::kBadCloud)
  {
    PoseExplanation nothing;
    nothing.result = std::move(result);
    return nothing;
  }
  return explainPose(work.prepared.image, model, config_, T_cloud_model, work.candidates,
                     work.selected, std::move(result));
}
}  // namespace ppf_bin_picking
