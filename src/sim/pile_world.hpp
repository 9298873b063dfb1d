/// @file The parts of a pile in Bullet's world.
#pragma once

#include "ppf_bin_picking/sim/part_pile.hpp"
#include "ppf_bin_picking/sim/random.hpp"

#include "bullet_shapes.hpp"
#include "mass_properties.hpp"

#include <Eigen/Geometry>
#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace ppf_bin_picking
{
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

  void drop(int count, std::uint32_t seed);
  void remove(std::size_t index);
  void settle();
  void wake();
  void simulate(double time_s);
  std::vector<Eigen::Isometry3d> poses() const;
  std::size_t count() const { return parts_.size(); }

private:
  void addBin();
  void addBody(btCollisionShape* shape, const btTransform& pose, bool moves);
  btTransform randomStart();
  bool liftAbovePile(btTransform& start, const btRigidBody* itself);
  bool hangsOverRim(const btRigidBody& body) const;
  bool isInBin(const btRigidBody& body) const;
  Eigen::Isometry3d pose(const btRigidBody& body) const;
  std::size_t dropStrays();
  bool isAwake() const;
  void wakeAround(const btRigidBody& body);
  double move_m(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  void limitSleep(double speed_m_s);
  void letSleep(const std::vector<bool>& rested);
  double speed_m_s(const btRigidBody& body) const;
  void step();

  btVector3 toBullet(const Eigen::Vector3d& point_m) const { return bulletPoint(point_m * scale_); }
  double toMetres(btScalar length) const { return length / scale_; }

  const Bin bin_;
  const PhysicsSettings settings_;
  const MassProperties mass_;
  const double scale_;   ///< Bullet's units per metre.
  Points corners_body_;  ///< Of the part [m].
  double reach_m_ = 0;   ///< From the centre of mass to the furthest of them.
  PartShape shape_;
  Random random_{0};  ///< For what leaves the bin before the first drop().
  std::vector<std::unique_ptr<btConvexHullShape>> bin_shapes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btRigidBody>> bin_bodies_;
  std::vector<std::unique_ptr<btRigidBody>> parts_;
};
}  // namespace ppf_bin_picking
