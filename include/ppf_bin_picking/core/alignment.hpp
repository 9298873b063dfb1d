/// @file The alignment kernel's arguments and results in the core's types.
#pragma once

#include "ppf_bin_picking/core/alignment_kernel.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// @return Valid as long as the image.
inline ImageArrays arraysOf(const RangeImage& image)
{
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "normals lie one after the other");
  const PinholeCamera& camera = image.camera;
  return {camera.width, camera.height, camera.fx,          camera.fy,
          camera.cx,    camera.cy,     image.depth.data(), image.normals.front().data()};
}

inline RigidMotion motionOf(const Eigen::Isometry3f& T_camera_samples)
{
  RigidMotion motion;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
      motion.rotation[i][j] = T_camera_samples.linear()(i, j);
    motion.shift_m[i] = T_camera_samples.translation()(i);
  }
  return motion;
}

/// The weighted normal equations of one step.
struct NormalEquations
{
  Matrix6f matrix = Matrix6f::Zero();
  Vector6f right_side = Vector6f::Zero();
  float weight = 0;

  void add(const Vector6f& jacobian, float residual, float w)
  {
    matrix += w * jacobian * jacobian.transpose();
    right_side += w * residual * jacobian;
    weight += w;
  }
};

/// sumAlignment() in these types.
inline NormalEquations alignmentOf(const PointArrays& samples, const ImageArrays& image,
                                   const Eigen::Isometry3f& T_camera_samples,
                                   const AlignmentTerms& terms)
{
  AlignmentSums sums;
  sumAlignment(samples, image, motionOf(T_camera_samples), terms, sums);
  NormalEquations equations;
  equations.right_side = Vector6f(sums.right_side);
  equations.weight = sums.weight;
  int next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      equations.matrix(i, j) = equations.matrix(j, i) = sums.squares[next++];
  return equations;
}
}  // namespace ppf_bin_picking
