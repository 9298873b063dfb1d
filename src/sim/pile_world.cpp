#include "pile_world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMostSettling_s = 60;  // simulated
constexpr double kCreep_m = 0.0001;     // no point of a resting part gets further in rest_s
constexpr double kLeniency_s = 5;       // in which as much again is let pass, of speed and creep
constexpr std::size_t kMostDrops = 3;   // of each part, on average, until it settles ...
constexpr std::size_t kBadLuck = 9;  // ... and of all: a few parts may all miss the bin by chance
constexpr double kDamping = 0.1;     // share of the speed lost in a second
constexpr double kStick_m_s = 0.01;  // slower parts stick
// Slow parts move as if through oil, which swallows the solver's jitter. What is not supported
// still moves: a two-thousandth of its weight takes it further in a second than a resting part may.
constexpr double kSlow_m_s = 0.05;
constexpr double kSlowDrag_1_s = 5;
constexpr int kIterations = 60;        // of the solver, each step
constexpr btScalar kPushApart = 0.1F;  // share of a penetration that a step mends
constexpr btScalar kNoBounce = 1;      // slower contacts do not bounce [Bullet's units a second]

}  // namespace

PartPile::World::World(const Bin& bin, const TriangleMesh& part, const ConvexHulls& hulls,
                       const PhysicsSettings& settings)
    : bin_(bin),
      settings_(settings),
      mass_(massProperties(hulls)),
      scale_(1 / largestExtent(hulls)),
      shape_(hulls, mass_.T_part_body.inverse(), scale_)
{
  const Eigen::Isometry3d T_body_part = mass_.T_part_body.inverse();
  for (const Eigen::Vector3f& vertex : part.vertices)
  {
    corners_body_.emplace_back(T_body_part * vertex.cast<double>());
    reach_m_ = std::max(reach_m_, corners_body_.back().norm());
  }
  world_.setGravity(btVector3(0, 0, static_cast<btScalar>(-settings.gravity_m_s2 * scale_)));
  btContactSolverInfo& solver = world_.getSolverInfo();
  solver.m_numIterations = kIterations;
  solver.m_splitImpulse = 1;
  solver.m_splitImpulsePenetrationThreshold = 0;  // always: pushing apart adds no speed
  // The forces of a pile at rest are those of the step before, and what is turned into another part
  // turns back, too: with less of either (Bullet has 0.85 and 0.1) piles creep.
  solver.m_warmstartingFactor = 1;
  solver.m_splitImpulseTurnErp = 1;
  // Two fixed directions of friction: with one along the sliding, which hardly has a direction
  // where nothing slides, piles creep.
  solver.m_solverMode |=
      SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  solver.m_erp2 = kPushApart;
  solver.m_restitutionVelocityThreshold = kNoBounce;
  addBin();
}

PartPile::World::~World()
{
  for (const auto* bodies : {&parts_, &bin_bodies_})
    for (const auto& body : *bodies)
      world_.removeRigidBody(body.get());
}

/// Floor and walls. The floor is thick, and the walls get thicker downwards on their outside, which
/// no part touches, so that nothing is ever pressed through them.
void PartPile::World::addBin()
{
  const double x = bin_.size_m.x() / 2, y = bin_.size_m.y() / 2, z = bin_.size_m.z();
  const double w = bin_.wall_m;
  const double foot = w + z / 2;
  std::vector<Points> blocks(5);
  for (const double sign_x : {-1.0, 1.0})
    for (const double sign_y : {-1.0, 1.0})
    {
      for (const double depth : {0.0, -0.5 * std::min(x, y)})
        blocks[0].emplace_back(sign_x * (x + w), sign_y * (y + w), depth);
      for (const double sign : {-1.0, 1.0})
      {
        Points& along_y = blocks[sign < 0 ? 1 : 2];
        along_y.emplace_back(sign * (sign_x < 0 ? x : x + w), sign_y * (y + w), z);
        along_y.emplace_back(sign * (sign_x < 0 ? x : x + foot), sign_y * (y + foot), 0);
        Points& along_x = blocks[sign < 0 ? 3 : 4];
        along_x.emplace_back(sign_x * (x + w), sign * (sign_y < 0 ? y : y + w), z);
        along_x.emplace_back(sign_x * (x + foot), sign * (sign_y < 0 ? y : y + foot), 0);
      }
    }
  for (const Points& block : blocks)
  {
    bin_shapes_.push_back(hullShape(block, Eigen::Isometry3d::Identity(), scale_));
    addBody(bin_shapes_.back().get(), btTransform::getIdentity(), false);
  }
}

void PartPile::World::addBody(btCollisionShape* shape, const btTransform& pose, bool moves)
{
  // Mass 1; Bullet multiplies the frictions and restitutions of two bodies, and adds their levers.
  const Eigen::Vector3d moments = mass_.moments / mass_.volume * scale_ * scale_;
  const btVector3 inertia = moves ? bulletPoint(moments) : btVector3(0, 0, 0);
  btRigidBody::btRigidBodyConstructionInfo info(moves ? 1.0F : 0.0F, nullptr, shape, inertia);
  const double friction = std::sqrt(settings_.friction);
  info.m_startWorldTransform = pose;
  info.m_friction = static_cast<btScalar>(friction);
  info.m_restitution = static_cast<btScalar>(std::sqrt(settings_.restitution));
  if (friction > 0)
    info.m_rollingFriction =
        static_cast<btScalar>(settings_.rolling_friction_m * scale_ / (2 * friction));
  info.m_spinningFriction = info.m_rollingFriction;
  info.m_linearDamping = info.m_angularDamping = static_cast<btScalar>(kDamping);
  auto& bodies = moves ? parts_ : bin_bodies_;
  bodies.push_back(std::make_unique<btRigidBody>(info));
  // Friction pulls points back to where they first touched, up to its limit. What only stopped them
  // would let through what the solver leaves of the speed, step after step.
  bodies.back()->setCollisionFlags(bodies.back()->getCollisionFlags() |
                                   btCollisionObject::CF_HAS_FRICTION_ANCHOR);
  world_.addRigidBody(bodies.back().get());
}

/// At most, of any of its points.
double PartPile::World::speed_m_s(const btRigidBody& body) const
{
  return toMetres(body.getLinearVelocity().length()) +
         body.getAngularVelocity().length() * reach_m_;
}

void PartPile::World::step()
{
  const double slides = std::sqrt(settings_.friction);
  const double sticks = slides * std::sqrt(settings_.static_friction_rel);
  const double drag = std::exp(-kSlowDrag_1_s * settings_.step_s);
  for (const auto& part : parts_)
  {
    if (!part->isActive()) continue;
    part->setDeactivationTime(0);  // Bullet's clock, of which there is one a process, stands still
    const double speed = speed_m_s(*part);
    double keep = 1;
    if (speed > settings_.max_speed_m_s) keep = settings_.max_speed_m_s / speed;
    if (speed < kSlow_m_s) keep = drag;
    part->setFriction(static_cast<btScalar>(speed < kStick_m_s ? sticks : slides));
    part->setLinearVelocity(part->getLinearVelocity() * static_cast<btScalar>(keep));
    part->setAngularVelocity(part->getAngularVelocity() * static_cast<btScalar>(keep));
  }
  world_.stepSimulation(static_cast<btScalar>(settings_.step_s), 0);
}

/// What touches the part or nearly does. Bullet wakes sleepers beside what is awake, but not beside
/// what is gone.
void PartPile::World::wakeAround(const btRigidBody& body)
{
  const btBroadphasePairArray& pairs =
      broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
  for (int k = 0; k < pairs.size(); ++k)
  {
    const auto* first = static_cast<btCollisionObject*>(pairs[k].m_pProxy0->m_clientObject);
    const auto* second = static_cast<btCollisionObject*>(pairs[k].m_pProxy1->m_clientObject);
    if (first == &body) second->activate();
    if (second == &body) first->activate();
  }
}

void PartPile::World::remove(std::size_t index)
{
  const auto part = parts_.begin() + static_cast<std::ptrdiff_t>(index);
  wakeAround(**part);
  world_.removeRigidBody(part->get());
  parts_.erase(part);
}

void PartPile::World::wake()
{
  for (const auto& part : parts_)
    part->activate();
}

bool PartPile::World::isAwake() const
{
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const auto& part) { return part->isActive(); });
}

void PartPile::World::simulate(double time_s)
{
  for (int left = static_cast<int>(std::ceil(time_s / settings_.step_s)); left > 0; --left)
    step();
}

/// Faster parts do not want to sleep any longer.
void PartPile::World::limitSleep(double speed_m_s)
{
  for (const auto& part : parts_)
    part->setSleepingThresholds(static_cast<btScalar>(speed_m_s / 2 * scale_),
                                static_cast<btScalar>(speed_m_s / 2 / reach_m_));
}

/// In windows of rest_s. Parts that touch fall asleep together, after one in which all of them
/// rested. The longer that takes, the more passes for rest: in a full bin some part always creeps.
void PartPile::World::settle()
{
  const int steps = static_cast<int>(std::ceil(settings_.rest_s / settings_.step_s));
  std::size_t strays = 0;
  for (double time_s = 0; isAwake(); time_s += steps * settings_.step_s)
  {
    if (time_s >= kMostSettling_s)
      throw std::runtime_error(
          "the parts do not come to rest: give a higher rest speed, or a shorter step");
    std::vector<Eigen::Isometry3d> start;
    for (const auto& part : parts_)
      start.push_back(pose(*part));
    const double leniency = 1 + time_s / kLeniency_s;
    const double rest_speed_m_s = settings_.rest_speed_m_s * leniency;
    limitSleep(rest_speed_m_s);
    std::vector<bool> rested(parts_.size(), true);
    for (int i = 0; i < steps && isAwake(); ++i)
    {
      step();
      for (std::size_t k = 0; k < parts_.size(); ++k)
        rested[k] = rested[k] && speed_m_s(*parts_[k]) < rest_speed_m_s;
    }
    strays += dropStrays();
    if (strays > kMostDrops * parts_.size() + kBadLuck)
      throw std::invalid_argument("the bin overflows: drop fewer parts, or give a larger bin");
    for (std::size_t k = 0; k < parts_.size(); ++k)
      rested[k] = rested[k] && move_m(start[k], pose(*parts_[k])) < kCreep_m * leniency;
    letSleep(rested);
  }
  limitSleep(settings_.rest_speed_m_s);
}

/// Says which of the parts that are awake want to sleep, as Bullet looks at their speed only. With
/// the next step it puts those to sleep of which all that they touch want to.
void PartPile::World::letSleep(const std::vector<bool>& rested)
{
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k]->isActive())
      parts_[k]->setActivationState(rested[k] ? WANTS_DEACTIVATION : ACTIVE_TAG);
}

/// At most, of any of a part's points. Both are T_bin_body.
double PartPile::World::move_m(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const
{
  const Eigen::Isometry3d move = from.inverse() * to;
  return move.translation().norm() + Eigen::AngleAxisd(move.linear()).angle() * reach_m_;
}

/// @return T_bin_body [m].
Eigen::Isometry3d PartPile::World::pose(const btRigidBody& body) const
{
  const btVector3& origin = body.getWorldTransform().getOrigin();
  const btQuaternion turn = body.getWorldTransform().getRotation();
  Eigen::Isometry3d T_bin_body(
      Eigen::Quaterniond(turn.w(), turn.x(), turn.y(), turn.z()).normalized());
  T_bin_body.translation() = Eigen::Vector3d(origin.x(), origin.y(), origin.z()) / scale_;
  return T_bin_body;
}

std::vector<Eigen::Isometry3d> PartPile::World::poses() const
{
  std::vector<Eigen::Isometry3d> result;
  for (const auto& part : parts_)
    result.push_back(pose(*part) * mass_.T_part_body.inverse());
  return result;
}
}  // namespace ppf_bin_picking
