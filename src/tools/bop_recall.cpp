#include "bop_recall.hpp"

#include "ppf_bin_picking/core/surface_discrepancy.hpp"

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
constexpr int kThresholds = 10;
constexpr double kStep = 0.05;  // of the share of pixels, and of the diameter
constexpr double kStep_px = 5;  // in an image of kWidth_px columns
constexpr double kWidth_px = 640;
constexpr double kVisibility_m = 0.005;

/// Errors of each pose (row), best score first, against each target (column).
using ErrorTable = Eigen::MatrixXd;

/// step, 2 step, .. kThresholds step.
std::vector<double> multiplesOf(double step)
{
  std::vector<double> all;
  for (int i = 1; i <= kThresholds; ++i)
    all.push_back(i * step);
  return all;
}

int recalledBelow(const ErrorTable& table, double threshold)
{
  int recalled = 0;
  std::vector<bool> taken(static_cast<std::size_t>(table.cols()), false);
  for (Eigen::Index pose = 0; pose < table.rows(); ++pose)
  {
    Eigen::Index best = -1;
    for (Eigen::Index target = 0; target < table.cols(); ++target)
      if (!taken[static_cast<std::size_t>(target)] && table(pose, target) < threshold &&
          (best < 0 || table(pose, target) < table(pose, best)))
        best = target;
    if (best < 0) continue;
    taken[static_cast<std::size_t>(best)] = true;
    ++recalled;
  }
  return recalled;
}

double meanRecalled(const ErrorTable& table, const std::vector<double>& thresholds)
{
  double sum = 0;
  for (const double threshold : thresholds)
    sum += recalledBelow(table, threshold);
  return sum / static_cast<double>(thresholds.size());
}

/// The table of an error(pose, target).
template <class Error>
ErrorTable tableOf(const std::vector<Eigen::Isometry3d>& poses,
                   const std::vector<TrueObject>& targets, const Error& error)
{
  ErrorTable table(poses.size(), targets.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t j = 0; j < targets.size(); ++j)
      table(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          error(poses[i], targets[j].T_camera_model);
  return table;
}

RenderedPart rendered(const RenderableMesh& mesh, const Eigen::Isometry3d& pose,
                      const PinholeCamera& camera)
{
  RenderedPart part;
  renderPart(mesh, pose.cast<float>(), camera, part);
  part.normals = {};  // many, and not needed
  part.triangle = {};
  return part;
}

bool windowsMeet(const RenderedPart& a, const RenderedPart& b)
{
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

double recalledByVsd(const std::vector<Eigen::Isometry3d>& poses,
                     const std::vector<TrueObject>& targets, const RenderableMesh& mesh,
                     const DepthView& view, double diameter_m)
{
  const std::vector<double> tolerances_m = multiplesOf(kStep * diameter_m);
  std::vector<RenderedPart> truths;
  for (const TrueObject& target : targets)
    truths.push_back(rendered(mesh, target.T_camera_model, view.camera));
  std::vector<ErrorTable> tables(kThresholds, ErrorTable::Ones(poses.size(), targets.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    const RenderedPart found = rendered(mesh, poses[i], view.camera);
    for (std::size_t j = 0; j < targets.size(); ++j)
    {
      if (!windowsMeet(found, truths[j])) continue;  // no pixel in common
      const std::vector<double> errors = visibleSurfaceDiscrepancy(
          found, truths[j], view.camera, view.depth, kVisibility_m, tolerances_m);
      for (std::size_t k = 0; k < errors.size(); ++k)
        tables[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = errors[k];
    }
  }
  double sum = 0;
  for (const ErrorTable& table : tables)
    sum += meanRecalled(table, multiplesOf(kStep));
  return sum / kThresholds;
}
}  // namespace

RecalledTargets recalledTargets(const std::vector<ScoredPose>& poses,
                                const std::vector<TrueObject>& targets, const PoseErrors& errors,
                                const RenderableMesh& mesh, const DepthView& view)
{
  std::vector<Eigen::Isometry3d> ordered;
  for (const std::size_t index : byScore(poses))
    if (isRigid(poses[index].T_camera_model)) ordered.push_back(poses[index].T_camera_model);
  const std::vector<double> distances_m = multiplesOf(kStep * errors.diameter());
  const std::vector<double> distances_px = multiplesOf(kStep_px * view.camera.width / kWidth_px);
  const auto mssd = [&](const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
  { return errors.mssd(found, truth, distances_m.back()).error_m; };
  const auto mspd = [&](const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
  { return errors.mspd(found, truth, view.camera, distances_px.back()); };
  return {recalledByVsd(ordered, targets, mesh, view, errors.diameter()),
          meanRecalled(tableOf(ordered, targets, mssd), distances_m),
          meanRecalled(tableOf(ordered, targets, mspd), distances_px)};
}
}  // namespace ppf_bin_picking
