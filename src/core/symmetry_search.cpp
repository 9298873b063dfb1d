#include "ppf_bin_picking/core/symmetry_search.hpp"

#include "ppf_bin_picking/core/self_distance.hpp"

#include "symmetry_axes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kSomeSamples = 300;  // to turn down at once what is no symmetry
constexpr std::size_t kManySamples = 3000;
constexpr double kLooseRel = 0.03;        // of an axis that is not refined yet
constexpr double kSnap_rad = 0.0017;      // 0.1 degrees
constexpr double kSnapRel = 0.001;        // of a point's coordinates, to zero
constexpr double kSameAxis = 0.99;        // cosine; axes of one part are farther apart
constexpr double kSameMiss = 0.9988;      // cosine; an axis is refined over more than this
constexpr double kAcross = 0.1;           // cosine; two such axes are at right angles
constexpr double kTurn_rad = 2.0;         // of a revolution, to refine its axis
constexpr double kUnevenTurn_rad = 0.61;  // and, repeated, to check it

/// An axis and how many times a turn the part is back.
struct OrderedAxis
{
  SymmetryAxis line;
  int order = 1;
};

bool isNear(const SymmetryAxis& line, const std::vector<OrderedAxis>& axes, double least_cosine)
{
  return std::any_of(axes.begin(), axes.end(),
                     [&](const OrderedAxis& known)
                     { return std::abs(known.line.axis.dot(line.axis)) > least_cosine; });
}

/// The nearest of the 13 lines along and halfway between the coordinate axes, if it is near.
Eigen::Vector3d snapped(const Eigen::Vector3d& axis)
{
  Eigen::Vector3d largest = axis / axis.cwiseAbs().maxCoeff();
  for (double& component : largest)
    component = std::round(component);
  largest.normalize();
  const bool near = (largest - axis).norm() < kSnap_rad;
  Eigen::Vector3d result = near ? largest : axis;
  int first = 0;
  while (std::abs(result(first)) < 1e-9)
    ++first;
  return result(first) < 0 ? Eigen::Vector3d(-result) : result;
}

/// The line that a motion turns about.
SymmetryAxis lineOf(const Eigen::Isometry3d& motion, const Eigen::Vector3d& near)
{
  SymmetryAxis line;
  line.axis = Eigen::AngleAxisd(motion.linear()).axis();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - motion.linear();
  const Eigen::Matrix3d along = line.axis * line.axis.transpose();
  // Across the axis I - R has full rank; along it the line stays at `near`.
  line.point = near + (across.transpose() * across + along)
                          .ldlt()
                          .solve(across.transpose() * (motion * near - near));
  return line;
}

class SymmetrySearch
{
public:
  explicit SymmetrySearch(const SelfDistance& self)
      : self_(self), tolerance_m_(kFoundSymmetryRel * self.diameter())
  {
  }

  SymmetryGroup run()
  {
    if (isBall()) return ball();
    std::vector<OrderedAxis> axes, misses;
    for (const auto& lines : {principalLines, linesOfLikePoints})
      for (const SymmetryAxis& line : lines(self_))
      {
        if (isNear(line, axes, kSameAxis) || isNear(line, misses, kSameMiss)) continue;
        if (const auto round = revolutionNear(line)) return withFlip(*round);
        const OrderedAxis axis = ordered(line);
        (axis.order > 1 ? axes : misses).push_back(axis);
      }
    return assembled(axes);
  }

private:
  bool holds(const Eigen::Isometry3d& motion, std::size_t samples) const
  {
    return self_.deviation(motion, tolerance_m_, samples) <= tolerance_m_;
  }

  bool isBall() const
  {
    double least = self_.diameter(), most = 0;
    for (const Eigen::Vector3f& point : self_.surface().points)
    {
      const double radius = (point.cast<double>() - self_.center()).norm();
      least = std::min(least, radius);
      most = std::max(most, radius);
    }
    return most - least < tolerance_m_;
  }

  SymmetryGroup ball() const
  {
    const Eigen::Vector3d center = tidy(self_.center());
    return SymmetryGroup({},
                         {{Eigen::Vector3d::UnitZ(), center}, {Eigen::Vector3d::UnitX(), center}});
  }

  /// Coordinates that are as good as zero become zero.
  Eigen::Vector3d tidy(Eigen::Vector3d point) const
  {
    for (double& coordinate : point)
      if (std::abs(coordinate) < kSnapRel * self_.diameter()) coordinate = 0;
    return point;
  }

  /// The line with the point nearest to the mesh's origin, if that is tidy.
  SymmetryAxis tidyLine(const Eigen::Vector3d& axis, const Eigen::Vector3d& through) const
  {
    SymmetryAxis line;
    line.axis = snapped(axis);
    line.point = tidy(through - line.axis.dot(through) * line.axis);
    return line;
  }

  std::optional<SymmetryAxis> revolutionNear(SymmetryAxis line) const
  {
    const double loose_m = kLooseRel * self_.diameter();
    for (const double turn_rad : {M_PI / 2, 1.0, 0.4})
      if (self_.deviation(turnAbout(line, turn_rad), loose_m, kSomeSamples) > loose_m)
        return std::nullopt;
    line = lineOf(self_.refined(turnAbout(line, kTurn_rad), loose_m), self_.center());
    line = tidyLine(line.axis, line.point);
    for (int i = 1; i <= 10; ++i)
      if (!holds(turnAbout(line, i * kUnevenTurn_rad), kManySamples)) return std::nullopt;
    if (!holds(turnAbout(line, kTurn_rad), SelfDistance::kAll)) return std::nullopt;
    return line;
  }

  /// A revolution, with a half turn across it if the part has one.
  SymmetryGroup withFlip(const SymmetryAxis& line) const
  {
    const double along = line.axis.dot(self_.center() - line.point);
    SymmetryAxis across{line.axis.unitOrthogonal(), line.point + along * line.axis};
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
      if (std::abs(axis.dot(line.axis)) < 1e-9) across.axis = axis;
    const double loose_m = kLooseRel * self_.diameter();
    if (self_.deviation(turnAbout(across, M_PI), loose_m, kSomeSamples) > loose_m)
      return SymmetryGroup({}, {line});
    const Eigen::Isometry3d flip = self_.refined(turnAbout(across, M_PI), loose_m);
    const double shift = line.axis.dot(lineOf(flip, across.point).point - line.point);
    across.point = tidy(line.point + shift * line.axis);
    if (!holds(turnAbout(across, M_PI), SelfDistance::kAll)) return SymmetryGroup({}, {line});
    return SymmetryGroup({{across, M_PI}}, {line});
  }

  /// Whether all turns by one of `order` parts hold.
  bool allHold(const SymmetryAxis& line, int order, double tolerance_m, std::size_t samples) const
  {
    for (int k = order / 2; k >= 1; --k)
      if (self_.deviation(turnAbout(line, k * 2 * M_PI / order), tolerance_m, samples) >
          tolerance_m)
        return false;
    return true;
  }

  /// The highest order of an axis near a line, and that axis.
  OrderedAxis ordered(const SymmetryAxis& line) const
  {
    const double loose_m = kLooseRel * self_.diameter();
    SymmetryAxis exact = line;
    bool refined = false;
    for (int order = kMaxTurns; order >= 2; --order)
    {
      if (!refined && !allHold(line, order, loose_m, kSomeSamples)) continue;
      if (!refined)
      {
        const int half = order / 2;
        const Eigen::Isometry3d turn = turnAbout(line, half * 2 * M_PI / order);
        exact = lineOf(self_.refined(turn, loose_m), self_.center());
        exact = tidyLine(exact.axis, exact.point);
        refined = true;
      }
      if (allHold(exact, order, tolerance_m_, kSomeSamples) &&
          allHold(exact, order, tolerance_m_, kManySamples) &&
          holds(turnAbout(exact, 2 * M_PI / order), SelfDistance::kAll))
        return {exact, order};
    }
    return {line, 1};
  }

  /// Of the axes across a first one, that repeat every so many radians, the one along or halfway
  /// between coordinate axes, if there is one.
  static Eigen::Vector3d tidiestAcross(const Eigen::Vector3d& first, const Eigen::Vector3d& other,
                                       double repeat_rad)
  {
    Eigen::Vector3d across = (other - first.dot(other) * first).normalized();
    for (double turn_rad = 0; turn_rad < 2 * M_PI; turn_rad += repeat_rad)
    {
      const Eigen::Vector3d axis = Eigen::AngleAxisd(turn_rad, first) * across;
      Eigen::Vector3d tidy = snapped(axis);
      if (std::min((tidy - axis).norm(), (tidy + axis).norm()) > 0 &&
          std::abs(tidy.dot(first)) < 1e-9)
        return tidy;
    }
    return across;
  }

  /// The group of the axes, exact: measured axes would have no common closure. It follows from the
  /// axis of the highest order and one across it, or from two of a tetrahedron's half turns.
  SymmetryGroup assembled(std::vector<OrderedAxis> axes) const
  {
    if (axes.empty()) return {};
    std::stable_sort(axes.begin(), axes.end(),
                     [](const auto& a, const auto& b) { return a.order > b.order; });
    for (std::size_t i = 0; i < axes.size(); ++i)
      for (std::size_t j = i + 1; j < axes.size(); ++j)
        if (std::abs(axes[i].line.axis.dot(axes[j].line.axis)) < kAcross)
          if (const auto group = groupOfTwo(axes[i], axes[j], i == 0)) return *group;
    return SymmetryGroup({{axes.front().line, 2 * M_PI / axes.front().order}}, {});
  }

  /// The group of two axes at right angles, if it holds.
  /// @param alone  Whether they may make a group without a tetrahedron's thirds.
  std::optional<SymmetryGroup> groupOfTwo(const OrderedAxis& first, const OrderedAxis& across,
                                          bool alone) const
  {
    const Eigen::Vector3d center = tidy(meetingPoint({first.line, across.line}));
    const Eigen::Vector3d& a = first.line.axis;
    const Eigen::Vector3d b =
        tidiestAcross(a, across.line.axis, (across.order == 2 ? 1 : 2) * M_PI / first.order);
    const auto line = [&](const Eigen::Vector3d& axis) {
      return SymmetryAxis{axis, tidy(center - axis.dot(center) * axis)};
    };
    std::vector<DiscreteSymmetry> generators = {{line(a), 2 * M_PI / first.order},
                                                {line(b), 2 * M_PI / across.order}};
    std::optional<SymmetryGroup> two =
        alone ? groupThatHolds(generators) : std::optional<SymmetryGroup>();
    if (first.order != 2) return two;
    generators.push_back({line((a + b + a.cross(b)).normalized()), 2 * M_PI / 3});
    std::optional<SymmetryGroup> tetrahedron = groupThatHolds(generators);
    return tetrahedron ? tetrahedron : two;
  }

  std::optional<SymmetryGroup> groupThatHolds(const std::vector<DiscreteSymmetry>& generators) const
  {
    for (const DiscreteSymmetry& generator : generators)
      if (!holds(turnAbout(generator.line, generator.angle_rad), kManySamples)) return {};
    try
    {
      SymmetryGroup group(generators, {});
      for (const Eigen::Isometry3d& motion : group.motions())
        if (!holds(motion, kManySamples)) return {};
      return group;
    }
    catch (const std::invalid_argument&)  // no closure
    {
      return {};
    }
  }

  const SelfDistance& self_;
  double tolerance_m_;
};
}  // namespace

SymmetryGroup findSymmetries(const TriangleMesh& mesh)
{
  const SelfDistance self(mesh);
  return SymmetrySearch(self).run();
}
}  // namespace ppf_bin_picking
