#include "ppf_bin_picking/core/pca.hpp"

#include <Eigen/Dense>

namespace ppf_bin_picking
{
namespace
{
/// The direction or its opposite, whichever has its largest component positive.
Eigen::Vector3d signedAxis(const Eigen::Vector3d& axis)
{
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis(largest) < 0 ? Eigen::Vector3d(-axis) : axis;
}
}  // namespace

OrientedBox principalBox(const std::vector<Eigen::Vector3f>& points)
{
  OrientedBox box;
  if (points.empty()) return box;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points)
    mean += p.cast<double>();
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& p : points)
  {
    const Eigen::Vector3d offset = p.cast<double>() - mean;
    covariance += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);  // ascending eigenvalues
  Eigen::Matrix3d axes;
  axes.col(0) = signedAxis(solver.eigenvectors().col(2));
  axes.col(1) = signedAxis(solver.eigenvectors().col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));

  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points)
  {
    const Eigen::Vector3d along = axes.transpose() * (p.cast<double>() - mean);
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  box.size = high - low;
  box.T_cloud_box.linear() = axes;
  box.T_cloud_box.translation() = mean + axes * (low + high) / 2;
  return box;
}

double sideSum(const OrientedBox& box)
{
  return box.size.sum();
}
}  // namespace ppf_bin_picking
