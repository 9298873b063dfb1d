#include "bullet_shapes.hpp"

namespace ppf_bin_picking
{
namespace
{
constexpr double kMargin = 0.008;  // Bullet's units: of the part's extent
}

btVector3 bulletPoint(const Eigen::Vector3d& point)
{
  return {static_cast<btScalar>(point.x()), static_cast<btScalar>(point.y()),
          static_cast<btScalar>(point.z())};
}

btQuaternion bulletRotation(const Eigen::Quaterniond& rotation)
{
  return {static_cast<btScalar>(rotation.x()), static_cast<btScalar>(rotation.y()),
          static_cast<btScalar>(rotation.z()), static_cast<btScalar>(rotation.w())};
}

double largestExtent(const ConvexHulls& hulls)
{
  Eigen::AlignedBox3d box;
  for (const TriangleMesh& hull : hulls)
    for (const Eigen::Vector3f& vertex : hull.vertices)
      box.extend(vertex.cast<double>());
  return box.sizes().maxCoeff();
}

std::unique_ptr<btConvexHullShape> hullShape(const Points& points,
                                             const Eigen::Isometry3d& T_shape_points, double scale)
{
  const ConvexHull core = convexHull(points, kMargin / scale);
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3f& vertex : core.mesh.vertices)
    shape->addPoint(bulletPoint(T_shape_points * vertex.cast<double>() * scale), false);
  shape->setMargin(static_cast<btScalar>(core.shrunk_m * scale));
  shape->recalcLocalAabb();
  return shape;
}

PartShape::PartShape(const ConvexHulls& hulls, const Eigen::Isometry3d& T_body_part, double scale)
{
  for (const TriangleMesh& hull : hulls)
  {
    Points points;
    for (const Eigen::Vector3f& vertex : hull.vertices)
      points.push_back(vertex.cast<double>());
    hulls_.push_back(hullShape(points, T_body_part, scale));
    compound_.addChildShape(btTransform::getIdentity(), hulls_.back().get());
  }
}
}  // namespace ppf_bin_picking
