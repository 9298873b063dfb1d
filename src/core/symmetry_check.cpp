#include "ppf_bin_picking/core/symmetry_check.hpp"

#include "ppf_bin_picking/core/self_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kSamples = 3000;    // for each turn of a revolution
constexpr double kUnevenTurn_rad = 0.61;  // repeated, to check a revolution
constexpr double kSameTurn_rad = 0.04;    // orientations nearer than this are one

std::string numbers(const Eigen::Vector3d& values)
{
  std::ostringstream text;
  text.precision(4);
  for (int i = 0; i < 3; ++i)
    text << (i == 0 ? "[" : ", ") << (std::abs(values(i)) < 1e-9 ? 0.0 : values(i));
  return text.str() + "]";
}

/// `1/6 turn`, `2/5 turn`.
std::string turnInWords(double angle_rad)
{
  for (int n = 2; n <= kMaxTurns; ++n)
  {
    const double k = angle_rad * n / (2 * M_PI);
    if (std::abs(k - std::round(k)) < 1e-6)
      return std::to_string(static_cast<int>(std::lround(k))) + "/" + std::to_string(n) + " turn";
  }
  std::ostringstream text;
  text << angle_rad * 180 / M_PI << " degrees";
  return text.str();
}

/// The sentence about a turn that the mesh does not have.
std::string refusal(const std::string& turn, const SymmetryAxis& line, double deviation_m,
                    double allowed_m)
{
  std::ostringstream text;
  text.precision(2);
  text << "the mesh is not symmetric to the " << turn << " about the axis " << numbers(line.axis)
       << " through " << numbers(line.point * 1000) << " mm that the part file states: its surface "
       << "moves by " << std::fixed << deviation_m * 1000 << " mm, more than " << allowed_m * 1000
       << " mm; correct axis, point or angle, or leave the symmetries out to have them found";
  return text.str();
}
bool has(const SymmetryGroup& group, const SymmetryAxis& line, double angle_rad)
{
  const Eigen::Quaternionf turned(
      Eigen::AngleAxisf(static_cast<float>(angle_rad), line.axis.normalized().cast<float>()));
  return group.rotationDistance(Eigen::Quaternionf::Identity(), turned) < kSameTurn_rad;
}

bool hasRevolution(const SymmetryGroup& group, const SymmetryAxis& line)
{
  for (int i = 1; i <= 10; ++i)
    if (!has(group, line, i * kUnevenTurn_rad)) return false;
  return true;
}
}  // namespace

std::string symmetryProblem(const TriangleMesh& mesh, const SymmetryGroup& stated)
{
  if (stated.generators().empty() && stated.revolutionAxes().empty()) return {};
  const SelfDistance self(mesh);
  const double allowed_m = kStatedSymmetryRel * self.diameter();
  for (const DiscreteSymmetry& symmetry : stated.generators())
  {
    const SymmetryAxis line{symmetry.line.axis.normalized(), symmetry.line.point};
    const double deviation_m = self.deviation(turnAbout(line, symmetry.angle_rad));
    if (deviation_m > allowed_m)
      return refusal(turnInWords(symmetry.angle_rad), line, deviation_m, allowed_m);
  }
  for (const SymmetryAxis& given : stated.revolutionAxes())
  {
    const SymmetryAxis line{given.axis.normalized(), given.point};
    double deviation_m = 0;
    for (int i = 1; i <= 10; ++i)
      deviation_m =
          std::max(deviation_m, self.deviation(turnAbout(line, i * kUnevenTurn_rad),
                                               std::numeric_limits<double>::infinity(), kSamples));
    if (deviation_m > allowed_m) return refusal("revolution", line, deviation_m, allowed_m);
  }
  return {};
}

std::string unstatedSymmetries(const SymmetryGroup& stated, const SymmetryGroup& found,
                               double metres_per_unit)
{
  std::vector<DiscreteSymmetry> turns;
  for (const DiscreteSymmetry& symmetry : found.generators())
    if (!has(stated, symmetry.line, symmetry.angle_rad)) turns.push_back(symmetry);
  std::vector<SymmetryAxis> axes;
  for (const SymmetryAxis& line : found.revolutionAxes())
    if (!hasRevolution(stated, line)) axes.push_back(line);
  return turns.empty() && axes.empty() ? "" : describe({turns, axes}, metres_per_unit);
}

std::string describe(const SymmetryGroup& symmetries, double metres_per_unit)
{
  std::string text;
  const auto add = [&](const std::string& turn, const SymmetryAxis& line)
  {
    text += (text.empty() ? "" : "; ") + turn + " about " + numbers(line.axis) + " through " +
            numbers(line.point / metres_per_unit);
  };
  for (const SymmetryAxis& line : symmetries.revolutionAxes())
    add("every turn", line);
  for (const DiscreteSymmetry& symmetry : symmetries.generators())
    add(turnInWords(symmetry.angle_rad), symmetry.line);
  return text.empty() ? "none" : text;
}
}  // namespace ppf_bin_picking
