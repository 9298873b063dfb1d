/// @file Point-to-plane alignment of surface samples with a range image, on plain arrays. No Eigen
/// here: alignment_kernel.cpp is compiled for several instruction sets, and the processor's is
/// chosen when the program starts.
#pragma once

#include "ppf_bin_picking/core/pair_kernel.hpp"

namespace ppf_bin_picking
{
/// A RangeImage as plain arrays.
struct ImageArrays
{
  int width;
  int height;
  float fx;  ///< [px]
  float fy;
  float cx;
  float cy;
  const float* depth_m;  ///< 0 without measurement.
  const float* normals;  ///< Three a pixel; zero where unknown.
};

/// A turn and a shift [m].
struct RigidMotion
{
  float rotation[3][3];  ///< Row by row.
  float shift_m[3];
};

/// Which measurements count, and about what motions turn.
struct AlignmentTerms
{
  float center_m[3];  ///< Camera frame.
  float lever_m;      ///< Makes turns comparable to shifts.
  float gate_m;       ///< Of the distance from the measured plane.
  float min_normal_cosine;
};

/// Weighted sums over the samples: of J J^T, its upper triangle row by row, and of J r, with J the
/// motionJacobian of a sample and r its distance from the measured plane [m].
struct AlignmentSums
{
  float squares[21];
  float right_side[6];
  float weight;
};

/// Sums over the samples whose pixel shows a surface near them with a like normal, weighted by
/// Tukey's function of their distance over the gate.
/// @param samples  Of the part, in the frame that the motion takes to the camera's.
void sumAlignment(const PointArrays& samples, const ImageArrays& image,
                  const RigidMotion& T_camera_samples, const AlignmentTerms& terms,
                  AlignmentSums& sums);
}  // namespace ppf_bin_picking
