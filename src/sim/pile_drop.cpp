/// @file How parts get into the bin, and back into it.
#include "pile_world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDropGap_m = 0.005;    // between a part let go and what it falls onto
constexpr double kWallGap_m = 0.001;    // between a part let go and the walls
constexpr int kAttitudesTried = 100;    // until one fits between the walls
constexpr int kPlacesTried = 4;         // each round, for the next parts
constexpr double kDropRound_s = 0.03;   // from one round to the next
constexpr double kDropPause_s = 0.5;    // at most, until a part comes
constexpr double kNextDrop_m_s = 0.05;  // a part may be let go above slower ones

/// Rolls evenly over all attitudes.
Eigen::Quaterniond randomAttitude(Random& random)
{
  Eigen::Vector4d numbers;
  for (int k = 0; k < 4; ++k)
    numbers[k] = random.normal();
  return Eigen::Quaterniond(numbers.normalized());
}

}  // namespace

btTransform PartPile::World::randomStart()
{
  for (int trial = 0; trial < kAttitudesTried; ++trial)
  {
    const Eigen::Quaterniond attitude = randomAttitude(random_);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners_body_)
      box.extend(attitude * corner);
    const Eigen::Vector3d room =
        bin_.size_m - box.sizes() - Eigen::Vector3d::Constant(2 * kWallGap_m);
    if (room.x() < 0 || room.y() < 0) continue;
    const Eigen::Vector3d lowest_corner(
        random_.uniform(-room.x() / 2, room.x() / 2) - box.sizes().x() / 2,
        random_.uniform(-room.y() / 2, room.y() / 2) - box.sizes().y() / 2, 0);
    return btTransform(bulletRotation(attitude), toBullet(lowest_corner - box.min()));
  }
  throw std::invalid_argument(
      "the part does not fit into the bin: check the part's unit, or give a larger bin");
}

/// Lifts a part to just above the highest of the parts that it could fall onto. @return whether all
/// of those are slow. @param itself  may be in the pile already.
bool PartPile::World::liftAbovePile(btTransform& start, const btRigidBody* itself)
{
  btVector3 low, high;
  shape_.compound()->getAabb(start, low, high);
  bool slow = true;
  btScalar top = 0;
  for (const auto& part : parts_)
  {
    btVector3 part_low, part_high;
    part->getAabb(part_low, part_high);
    const bool beside = part_low.x() > high.x() || part_high.x() < low.x() ||
                        part_low.y() > high.y() || part_high.y() < low.y();
    if (beside || part.get() == itself) continue;
    top = std::max(top, part_high.z());
    slow = slow && speed_m_s(*part) < kNextDrop_m_s;
  }
  start.getOrigin() += btVector3(0, 0, top + static_cast<btScalar>(kDropGap_m * scale_));
  return slow;
}

/// Whether a corner hangs over the rim, lower than it and beyond the wall.
bool PartPile::World::hangsOverRim(const btRigidBody& body) const
{
  const Eigen::Array2d outside_m = bin_.size_m.head<2>().array() / 2 + bin_.wall_m;
  btVector3 low, high;
  body.getAabb(low, high);
  const double reach_x_m = toMetres(std::max(-low.x(), high.x()));
  const double reach_y_m = toMetres(std::max(-low.y(), high.y()));
  if (reach_x_m < outside_m.x() && reach_y_m < outside_m.y()) return false;  // most, and cheaply
  const Eigen::Isometry3d T_bin_body = pose(body);
  return std::any_of(corners_body_.begin(), corners_body_.end(),
                     [&](const Eigen::Vector3d& corner_body)
                     {
                       const Eigen::Vector3d corner = T_bin_body * corner_body;
                       return corner.z() < bin_.size_m.z() &&
                              (corner.head<2>().array().abs() > outside_m).any();
                     });
}

bool PartPile::World::isInBin(const btRigidBody& body) const
{
  const btVector3& center = body.getWorldTransform().getOrigin();
  return std::abs(toMetres(center.x())) < bin_.size_m.x() / 2 &&
         std::abs(toMetres(center.y())) < bin_.size_m.y() / 2 && center.z() > 0 &&
         !hangsOverRim(body);
}

/// Drops the parts again that have left the bin. @return how many.
std::size_t PartPile::World::dropStrays()
{
  std::size_t found = 0;
  for (const auto& part : parts_)
  {
    if (isInBin(*part)) continue;
    ++found;
    btTransform start = randomStart();
    liftAbovePile(start, part.get());
    wakeAround(*part);
    part->activate();
    part->setWorldTransform(start);
    part->setInterpolationWorldTransform(start);
    part->setLinearVelocity(btVector3(0, 0, 0));
    part->setAngularVelocity(btVector3(0, 0, 0));
    world_.updateSingleAabb(part.get());
    broadphase_.getOverlappingPairCache()->cleanProxyFromPairs(part->getBroadphaseHandle(),
                                                               &dispatcher_);
  }
  return found;
}

/// Several parts fall at once, where they cannot meet.
void PartPile::World::drop(int count, std::uint32_t seed)
{
  random_ = Random(seed);
  const int round = std::max(1, static_cast<int>(std::ceil(kDropRound_s / settings_.step_s)));
  double waited_s = 0;
  while (count > 0)
  {
    for (int trial = 0; trial < kPlacesTried && count > 0; ++trial)
    {
      btTransform start = randomStart();
      if (!liftAbovePile(start, nullptr) && waited_s < kDropPause_s) continue;
      addBody(shape_.compound(), start, true);
      --count;
      waited_s = 0;
    }
    for (int i = 0; i < round; ++i)
      step();
    waited_s += round * settings_.step_s;
    dropStrays();
  }
  settle();
}
}  // namespace ppf_bin_picking
