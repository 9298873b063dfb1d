/// @file Rigid parts falling into a bin.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/bin.hpp"
#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// How parts fall, touch and come to rest.
struct PhysicsSettings
{
  /// A tenth of the real one: what is a pile at rest does not depend on it, but the solver is the
  /// more exact the less speed gravity adds in a step. > 0.
  double gravity_m_s2 = 1;
  double friction = 0.35;  ///< Coulomb's coefficient of part on part and part on bin. >= 0.
  /// Times larger is it between parts slower than 10 mm/s (its root, between one and the bin).
  /// >= 1.
  double static_friction_rel = 1.3;
  double restitution = 0.1;            ///< Share of the speed that a bounce returns. In [0, 1).
  double rolling_friction_m = 0.0003;  ///< Lever arm of the rolling resistance. >= 0.
  double step_s = 1.0 / 480;           ///< Of the simulation. > 0.
  /// No point of a part moves faster, as if it were handed down rather than dropped: with the step
  /// it decides how deep parts can get into each other in one step. > 0.
  double max_speed_m_s = 0.5;
  double rest_speed_m_s = 0.02;  ///< A part rests if none of its points is faster. > 0.
  double rest_s = 1;             ///< For so long, all parts that touch at once. > 0.

  /// One sentence per broken rule; empty means usable.
  std::vector<std::string> problems() const;
};

/// Parts in a bin as rigid bodies. A part is as heavy as its hulls filled evenly; its weight does
/// not matter, as all have the same. The same calls give the same poses, bit for bit, whatever else
/// the process does; one object must not be used by two threads at once.
class PartPile
{
public:
  /// @param part   Its vertices say how much room it needs. Read by the constructor only.
  /// @param hulls  convexHulls() of it: what collides.
  /// @throw std::invalid_argument if the settings break a rule, or if there is no hull with a
  /// volume.
  PartPile(const Bin& bin, const TriangleMesh& part, const ConvexHulls& hulls,
           const PhysicsSettings& settings = {});
  ~PartPile();
  PartPile(const PartPile&) = delete;
  PartPile& operator=(const PartPile&) = delete;

  /// Drops parts at random attitudes and places from just above what lies there, each when the
  /// parts below it are slow, so that several fall side by side, and lets them come to rest. One
  /// that leaves the bin (its centre of mass is not over the floor, or a corner hangs outside of a
  /// wall, lower than the rim) is dropped again.
  /// @param count  >= 0.
  /// @throw std::invalid_argument if the part does not fit into the bin or the bin overflows.
  void drop(int count, std::uint32_t seed);

  /// Takes a part out; those after it move up one index. The others are where they were, but what
  /// touched it is awake: call settle() to let them fall into the gap.
  /// @throw std::out_of_range if there is no such part.
  void remove(std::size_t index);

  /// Simulates until every part sleeps. Parts that touch fall asleep together, after the settings'
  /// rest_s without a fast one and without one that got 0.1 mm further, both as much again for each
  /// 5 s that it takes; they wake together, when one that is awake touches them. Where all sleep,
  /// nothing changes, not a bit. One that leaves the bin is dropped again.
  /// @throw std::invalid_argument if the bin overflows. @throw std::runtime_error if it takes more
  ///        than a minute of simulated time.
  void settle();

  /// Wakes every part, as if none had come to rest.
  void wake();

  /// Simulates for so long [s]. What sleeps goes on sleeping if nothing touches it, and nothing
  /// falls asleep.
  void simulate(double time_s);

  /// T_bin_part, in the order of dropping.
  std::vector<Eigen::Isometry3d> poses() const;

private:
  class World;
  std::unique_ptr<World> world_;
};
}  // namespace ppf_bin_picking
