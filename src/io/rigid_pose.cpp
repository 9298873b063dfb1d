#include "ppf_bin_picking/io/rigid_pose.hpp"

namespace ppf_bin_picking
{
namespace
{
constexpr double kRotationTolerance = 1e-3;  // of each entry, for files with few digits
using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
}  // namespace

std::optional<Eigen::Isometry3d> rigidPose(const std::vector<double>& row_major)
{
  if (row_major.size() != 16) return std::nullopt;
  Eigen::Isometry3d pose;
  pose.matrix() = Eigen::Map<const RowMajor>(row_major.data());
  const Eigen::Matrix3d product = pose.linear() * pose.linear().transpose();
  const bool rigid = pose.matrix().allFinite() &&
                     product.isApprox(Eigen::Matrix3d::Identity(), kRotationTolerance) &&
                     pose.linear().determinant() > 0 &&
                     pose.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  return rigid ? std::optional<Eigen::Isometry3d>(pose) : std::nullopt;
}

std::array<double, 16> rowMajor(const Eigen::Isometry3d& pose)
{
  std::array<double, 16> numbers{};
  Eigen::Map<RowMajor>(numbers.data()) = pose.matrix();
  return numbers;
}
}  // namespace ppf_bin_picking
