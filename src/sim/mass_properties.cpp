#include "mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <stdexcept>

namespace ppf_bin_picking
{
MassProperties massProperties(const ConvexHulls& bodies)
{
  MassProperties result;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // integral of p
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // integral of p p^T
  for (const TriangleMesh& body : bodies)
    for (const auto& triangle : body.triangles)
    {
      // The tetrahedron of the triangle and the origin, its volume with a sign.
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = body.vertices[triangle[k]].cast<double>();
      const double volume = corners.determinant() / 6;
      const Eigen::Vector3d sum = corners.rowwise().sum();
      result.volume += volume;
      first += volume / 4 * sum;
      second += volume / 20 * (corners * corners.transpose() + sum * sum.transpose());
    }
  if (!(result.volume > 0))
    throw std::invalid_argument("the part's hulls have no volume: give those of convexHulls()");
  const Eigen::Vector3d center = first / result.volume;
  const Eigen::Matrix3d spread = second - result.volume * center * center.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  Eigen::Matrix3d rotation = axes.eigenvectors();
  if (rotation.determinant() < 0) rotation.col(2) *= -1;
  result.T_part_body.linear() = rotation;
  result.T_part_body.translation() = center;
  result.moments = Eigen::Vector3d::Constant(spread.trace()) - axes.eigenvalues();
  return result;
}
}  // namespace ppf_bin_picking
