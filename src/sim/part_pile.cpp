#include "ppf_bin_picking/sim/part_pile.hpp"

#include "ppf_bin_picking/sim/random.hpp"

#include "bullet_shapes.hpp"
#include "mass_properties.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDropGap_m = 0.005;    // between the pile's highest point and a part let go
constexpr double kWallGap_m = 0.001;    // between a part let go and the walls
constexpr int kAttitudesTried = 100;    // until one fits between the walls
constexpr double kDropPause_s = 0.3;    // at most, from one part to the next
constexpr double kSlow_m_s = 0.05;      // the next part may come
constexpr double kMostSettling_s = 60;  // simulated
constexpr int kMostDrops = 10;          // of each part
constexpr double kDamping = 0.1;        // share of the speed lost in a second
constexpr int kIterations = 40;         // of the solver, each step
constexpr btScalar kPushApart = 0.1F;   // share of a penetration that a step mends
constexpr btScalar kNoBounce = 1;       // slower contacts do not bounce [Bullet's units a second]

/// Rolls evenly over all attitudes.
Eigen::Quaterniond randomAttitude(Random& random)
{
  Eigen::Vector4d numbers;
  for (int k = 0; k < 4; ++k)
    numbers[k] = random.normal();
  return Eigen::Quaterniond(numbers.normalized());
}

void requireUsable(const PhysicsSettings& settings)
{
  std::string all;
  for (const std::string& problem : settings.problems())
    all += (all.empty() ? "" : "; ") + problem;
  if (!all.empty()) throw std::invalid_argument(all);
}
}  // namespace

/// Bullet's world. One of its units is the part's largest extent, as Bullet's tolerances suit
/// bodies of about 1 and parts differ.
class PartPile::World
{
public:
  World(const Bin& bin, const TriangleMesh& part, const ConvexHulls& hulls,
        const PhysicsSettings& settings);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void drop(int count, Random& random);
  void remove(std::size_t index);
  void settle();
  std::vector<Eigen::Isometry3d> poses() const;

private:
  void addBin();
  void addBody(btCollisionShape* shape, const btTransform& pose, bool moves);
  btTransform randomStart(Random& random, double lowest_m) const;
  double pileTop_m() const;
  bool isOverFloor(const btRigidBody& body) const;
  bool dropStrays(Random& random);
  double fastest_m_s() const;
  void step();

  btVector3 toBullet(const Eigen::Vector3d& point_m) const { return bulletPoint(point_m * scale_); }
  double toMetres(btScalar length) const { return length / scale_; }

  const Bin bin_;
  const PhysicsSettings settings_;
  const MassProperties mass_;
  const double scale_;  ///< Bullet's units per metre.
  Points corners_body_;  ///< Of the part [m].
  double reach_m_ = 0;   ///< From the centre of mass to the furthest of them.
  PartShape shape_;
  std::vector<std::unique_ptr<btConvexHullShape>> bin_shapes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btRigidBody>> bin_bodies_;
  std::vector<std::unique_ptr<btRigidBody>> parts_;
};

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
  // Never put to sleep: what rests is decided by looking at the whole pile.
  bodies.back()->setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(bodies.back().get());
}

btTransform PartPile::World::randomStart(Random& random, double lowest_m) const
{
  for (int trial = 0; trial < kAttitudesTried; ++trial)
  {
    const Eigen::Quaterniond attitude = randomAttitude(random);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners_body_)
      box.extend(attitude * corner);
    const Eigen::Vector3d room =
        bin_.size_m - box.sizes() - Eigen::Vector3d::Constant(2 * kWallGap_m);
    if (room.x() < 0 || room.y() < 0) continue;
    const Eigen::Vector3d lowest_corner(random.uniform(-room.x() / 2, room.x() / 2) - box.sizes().x() / 2,
                                        random.uniform(-room.y() / 2, room.y() / 2) - box.sizes().y() / 2,
                                        lowest_m);
    return btTransform(bulletRotation(attitude), toBullet(lowest_corner - box.min()));
  }
  throw std::invalid_argument(
      "the part does not fit into the bin: check the part's unit, or give a larger bin");
}

double PartPile::World::pileTop_m() const
{
  double top = 0;
  for (const auto& part : parts_)
  {
    btVector3 low, high;
    part->getAabb(low, high);
    top = std::max(top, toMetres(high.z()));
  }
  return top;
}

bool PartPile::World::isOverFloor(const btRigidBody& body) const
{
  const btVector3& center = body.getWorldTransform().getOrigin();
  return std::abs(toMetres(center.x())) < bin_.size_m.x() / 2 &&
         std::abs(toMetres(center.y())) < bin_.size_m.y() / 2 && center.z() > 0;
}

/// Drops the parts again that have left the bin. @return whether there were any.
bool PartPile::World::dropStrays(Random& random)
{
  bool found = false;
  for (const auto& part : parts_)
  {
    if (isOverFloor(*part)) continue;
    found = true;
    part->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0)));
    world_.updateSingleAabb(part.get());
    const btTransform start = randomStart(random, pileTop_m() + kDropGap_m);
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

double PartPile::World::fastest_m_s() const
{
  double fastest = 0;
  for (const auto& part : parts_)
    fastest = std::max(fastest, toMetres(part->getLinearVelocity().length()) +
                                    part->getAngularVelocity().length() * reach_m_);
  return fastest;
}

void PartPile::World::step()
{
  for (const auto& part : parts_)
  {
    const double speed = toMetres(part->getLinearVelocity().length()) +
                         part->getAngularVelocity().length() * reach_m_;
    if (speed <= settings_.max_speed_m_s) continue;
    const auto slower = static_cast<btScalar>(settings_.max_speed_m_s / speed);
    part->setLinearVelocity(part->getLinearVelocity() * slower);
    part->setAngularVelocity(part->getAngularVelocity() * slower);
  }
  world_.stepSimulation(static_cast<btScalar>(settings_.step_s), 0);
}

void PartPile::World::drop(int count, Random& random)
{
  const int pause = static_cast<int>(std::ceil(kDropPause_s / settings_.step_s));
  for (int k = 0; k < count; ++k)
  {
    addBody(shape_.compound(), randomStart(random, pileTop_m() + kDropGap_m), true);
    for (int i = 0; i < pause && (i < pause / 4 || fastest_m_s() > kSlow_m_s); ++i)
      step();
    dropStrays(random);
  }
  settle();
  for (int again = 0; dropStrays(random); ++again)
  {
    if (again == kMostDrops)
      throw std::invalid_argument(
          "the bin overflows: drop fewer parts, or give a larger bin");
    settle();
  }
}

void PartPile::World::remove(std::size_t index)
{
  const auto part = parts_.begin() + static_cast<std::ptrdiff_t>(index);
  world_.removeRigidBody(part->get());
  parts_.erase(part);
}

void PartPile::World::settle()
{
  double resting_s = 0;
  for (double time_s = 0; resting_s < settings_.rest_s; time_s += settings_.step_s)
  {
    if (time_s > kMostSettling_s)
      throw std::runtime_error("the parts do not come to rest: give a higher rolling friction or "
                               "rest speed, or a shorter step");
    step();
    resting_s = fastest_m_s() > settings_.rest_speed_m_s ? 0 : resting_s + settings_.step_s;
  }
}

std::vector<Eigen::Isometry3d> PartPile::World::poses() const
{
  std::vector<Eigen::Isometry3d> result;
  for (const auto& part : parts_)
  {
    const btTransform& pose = part->getWorldTransform();
    const btQuaternion turn = pose.getRotation();
    Eigen::Isometry3d T_bin_body(
        Eigen::Quaterniond(turn.w(), turn.x(), turn.y(), turn.z()).normalized());
    T_bin_body.translation() = Eigen::Vector3d(pose.getOrigin().x(), pose.getOrigin().y(),
                                               pose.getOrigin().z()) / scale_;
    result.push_back(T_bin_body * mass_.T_part_body.inverse());
  }
  return result;
}

std::vector<std::string> PhysicsSettings::problems() const
{
  std::vector<std::string> found;
  const auto require = [&](bool holds, const char* rule)
  {
    if (!holds) found.emplace_back(rule);
  };
  require(gravity_m_s2 > 0, "gravity_m_s2 must be above 0");
  require(friction >= 0, "friction must not be negative");
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
  Random random(seed);
  world_->drop(count, random);
}

void PartPile::remove(std::size_t index)
{
  if (index >= poses().size())
    throw std::out_of_range("there is no part " + std::to_string(index) + " in the bin");
  world_->remove(index);
}

void PartPile::settle()
{
  world_->settle();
}

std::vector<Eigen::Isometry3d> PartPile::poses() const
{
  return world_->poses();
}
}  // namespace ppf_bin_picking
