/// @file Whether a gripper that is sent to a pose would come back with a part.
#pragma once

#include "ppf_bin_picking/core/pose_errors.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// What makes a pick succeed.
struct PickRule
{
  /// A pose is right if no point of the part's surface is off by more than this, relative to the
  /// part's diameter (MSSD, symmetric poses being the same). In (0, 1].
  double tolerance_rel = 0.1;

  /// What lies higher than the part meant by less than this [m] is below it or beside it: parts
  /// that touch sink into each other a little. In [0.0001, 0.1].
  double contact_m = 0.002;

  /// Parts push each other aside by up to this on their way up, relative to the part's diameter.
  /// In [0.01, 1].
  double push_rel = 0.05;
};

/// What became of a pick.
enum class PickOutcome
{
  kTaken,        ///< The pose is right and the part free.
  kNoPartThere,  ///< No part has this pose.
  kCovered       ///< The pose is right, but another part lies over it.
};

/// The judgement of one pose. Parts are counted from 0 as in the list of poses.
struct PickVerdict
{
  PickOutcome outcome = PickOutcome::kNoPartThere;
  std::size_t part = 0;        ///< The part meant, or the nearest one; 0 if there are none.
  double error_m = 0;          ///< MSSD to this part; infinite if there are none.
  std::size_t covered_by = 0;  ///< For kCovered: the part over most of it.
  std::string message;         ///< What happens or why not, in a few words; mm and deg.
};

/// Judges picks of one part by where its copies really lie. Immutable.
class PickJudge
{
public:
  /// @param part  A closed mesh [m].
  /// @throw std::invalid_argument if the part has no vertices or the rule is out of range.
  PickJudge(TriangleMesh part, const SymmetryGroup& symmetries, const PickRule& rule);

  /// @param T_bin_model   The pose to be picked [m]; z of the bin's frame is up.
  /// @param T_bin_parts  Where the parts lie.
  PickVerdict judge(const Eigen::Isometry3d& T_bin_model,
                    const std::vector<Eigen::Isometry3d>& T_bin_parts) const;

  /// The part's diameter: the largest distance between two vertices [m].
  double diameter() const { return errors_.diameter(); }

private:
  /// The part that lies over most of the part of this index, if one does.
  std::optional<std::size_t> partOver(std::size_t index,
                                      const std::vector<Eigen::Isometry3d>& T_bin_parts) const;
  std::string missText(const Eigen::Isometry3d& T_bin_model, const Eigen::Isometry3d& T_bin_nearest,
                       const PickVerdict& verdict) const;

  TriangleMesh part_;
  PickRule rule_;
  PoseErrors errors_;
};
}  // namespace ppf_bin_picking
