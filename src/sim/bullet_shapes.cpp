#include "bullet_shapes.hpp"

namespace ppf_bin_picking
{
namespace
{
// In Bullet's units, that is of the part's extent:
constexpr double kMargin = 0.008;
constexpr double kSimpler = 0.001;  // what a vertex must stick out by to be kept

Points toPoints(const TriangleMesh& mesh)
{
  Points points;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    points.push_back(vertex.cast<double>());
  return points;
}

/// Without those that hardly stick out: where faces moved inwards, a vertex of theirs has become
/// several, close together.
Points simplifiedVertices(const TriangleMesh& hull, double tolerance_m)
{
  const Points all = toPoints(hull);
  if (all.size() <= 8) return all;
  const Points fewer = toPoints(simplifiedHull(all, tolerance_m, all.size()).mesh);
  return fewer.empty() ? all : fewer;
}
}  // namespace

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
  for (const Eigen::Vector3d& vertex : simplifiedVertices(core.mesh, kSimpler / scale))
    shape->addPoint(bulletPoint(T_shape_points * vertex * scale), false);
  shape->setMargin(static_cast<btScalar>(core.shrunk_m * scale));
  shape->recalcLocalAabb();
  return shape;
}

PartShape::PartShape(const ConvexHulls& hulls, const Eigen::Isometry3d& T_body_part, double scale)
{
  for (const TriangleMesh& hull : hulls)
  {
    hulls_.push_back(hullShape(toPoints(hull), T_body_part, scale));
    compound_.addChildShape(btTransform::getIdentity(), hulls_.back().get());
  }
}
}  // namespace ppf_bin_picking
