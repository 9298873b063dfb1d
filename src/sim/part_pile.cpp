#include "ppf_bin_picking/sim/part_pile.hpp"

#include "pile_world.hpp"

#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
void requireUsable(const PhysicsSettings& settings)
{
  std::string all;
  for (const std::string& problem : settings.problems())
    all += (all.empty() ? "" : "; ") + problem;
  if (!all.empty()) throw std::invalid_argument(all);
}
}  // namespace

std::vector<std::string> PhysicsSettings::problems() const
{
  std::vector<std::string> found;
  const auto require = [&](bool holds, const char* rule)
  {
    if (!holds) found.emplace_back(rule);
  };
  require(gravity_m_s2 > 0, "gravity_m_s2 must be above 0");
  require(friction >= 0, "friction must not be negative");
  require(static_friction_rel >= 1, "static_friction_rel must be at least 1");
  require(restitution >= 0 && restitution < 1, "restitution must be in [0, 1)");
  require(rolling_friction_m >= 0, "rolling_friction_m must not be negative");
  require(step_s > 0, "step_s must be above 0");
  require(max_speed_m_s > 0, "max_speed_m_s must be above 0");
  require(rest_speed_m_s > 0, "rest_speed_m_s must be above 0");
  require(rest_s > 0, "rest_s must be above 0");
  return found;
}

PartPile::PartPile(const Bin& bin, const TriangleMesh& part, const ConvexHulls& hulls,
                   const PhysicsSettings& settings)
{
  requireUsable(settings);
  world_ = std::make_unique<World>(bin, part, hulls, settings);
}

PartPile::~PartPile() = default;

void PartPile::drop(int count, std::uint32_t seed)
{
  world_->drop(count, seed);
}

void PartPile::remove(std::size_t index)
{
  if (index >= world_->count())
    throw std::out_of_range("there is no part " + std::to_string(index) + " in the bin");
  world_->remove(index);
}

void PartPile::settle()
{
  world_->settle();
}

void PartPile::wake()
{
  world_->wake();
}

void PartPile::simulate(double time_s)
{
  world_->simulate(time_s);
}

std::vector<Eigen::Isometry3d> PartPile::poses() const
{
  return world_->poses();
}
}  // namespace ppf_bin_picking
