/// @file What voting does for every pair and every cell, on plain arrays. No Eigen here:
/// pair_kernel.cpp is compiled for several instruction sets, and the processor's is chosen when the
/// program starts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
constexpr std::uint32_t kNoKey = 0xFFFFFFFFU;  ///< Of a pair too long, or of a point with itself.

/// Full turn of an alpha (pairAlpha).
constexpr std::uint32_t kAlphaTurn = 65536;

/// Points [m] with unit normals, one array a coordinate.
struct PointArrays
{
  std::vector<float> x, y, z, nx, ny, nz;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t count)
  {
    for (std::vector<float>* array : {&x, &y, &z, &nx, &ny, &nz})
      array->resize(count);
  }
  /// Appends a point, from its coordinates and those of its normal.
  void add(const float* point, const float* normal)
  {
    x.push_back(point[0]), y.push_back(point[1]), z.push_back(point[2]);
    nx.push_back(normal[0]), ny.push_back(normal[1]), nz.push_back(normal[2]);
  }
  /// Sets a point from its coordinates and those of its normal.
  void set(std::size_t i, const float* point, const float* normal)
  {
    x[i] = point[0], y[i] = point[1], z[i] = point[2];
    nx[i] = normal[0], ny[i] = normal[1], nz[i] = normal[2];
  }
};

/// A point [m] with its unit normal, and two more axes that complete its frame.
struct PairReference
{
  float p[3];
  float n[3];
  float y_axis[3];
  float z_axis[3];
};

/// How features are rounded to keys.
struct KeySteps
{
  float diameter_m;
  float inverse_distance_step;  ///< [1/m]
  float inverse_angle_step;     ///< [1/rad]
  std::int32_t distance_bins;
  std::int32_t angle_bins;
};

/// The arc cosine [rad], to 1e-7; of cosines beyond 1 that of 1. Abramowitz and Stegun 1964,
/// 4.4.46.
inline float arcCosine(float cosine)
{
  const float x = std::min(std::abs(cosine), 1.0F);
  const float polynomial =
      1.5707963F +
      x * (-0.2145988F +
           x * (0.08897899F +
                x * (-0.0501743F + x * (0.03089188F + x * (-0.01708813F +
                                                           x * (0.00667009F - x * 0.00126249F))))));
  const float angle = std::sqrt(1.0F - x) * polynomial;
  return cosine < 0 ? 3.14159265F - angle : angle;
}

/// The angle from the x axis to (x, y) in turns, in [0, 1], to 1e-7; 0 for the origin. Abramowitz
/// and Stegun 1964, 4.4.49.
inline float turnsOf(float x, float y)
{
  const float along = std::abs(x), across = std::abs(y);
  const float larger = std::max(along, across);
  const float ratio = std::min(along, across) / (larger > 0 ? larger : 1.0F);
  const float s = ratio * ratio;
  const float polynomial =
      1.0F +
      s * (-0.3333314528F +
           s * (0.1999355085F +
                s * (-0.1420889944F +
                     s * (0.1065626393F +
                          s * (-0.0752896400F +
                               s * (0.0429096138F + s * (-0.0161657367F + s * 0.0028662257F)))))));
  float turns = ratio * polynomial * 0.159154943F;
  turns = across > along ? 0.25F - turns : turns;
  turns = x < 0 ? 0.5F - turns : turns;
  return y < 0 ? 1.0F - turns : turns;
}

/// The number of an angle's step.
inline std::int32_t angleBin(const KeySteps& steps, float angle_rad)
{
  return std::min(static_cast<std::int32_t>(angle_rad * steps.inverse_angle_step),
                  steps.angle_bins - 1);
}

/// The key of a feature: distance and the angles n1 to d, n2 to d, n1 to n2.
inline std::uint32_t keyOf(const KeySteps& steps, float distance_m, float angle_n1_d_rad,
                           float angle_n2_d_rad, float angle_n1_n2_rad)
{
  std::int32_t key = std::min(static_cast<std::int32_t>(distance_m * steps.inverse_distance_step),
                              steps.distance_bins - 1);
  key = key * steps.angle_bins + angleBin(steps, angle_n1_d_rad);
  key = key * steps.angle_bins + angleBin(steps, angle_n2_d_rad);
  return static_cast<std::uint32_t>(key * steps.angle_bins + angleBin(steps, angle_n1_n2_rad));
}

/// The turn about the x axis that brings (y, z) onto the y axis, as a share of kAlphaTurn.
inline std::uint16_t alphaOf(float y, float z)
{
  const auto steps = static_cast<std::int32_t>(turnsOf(y, -z) * static_cast<float>(kAlphaTurn));
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(steps) % kAlphaTurn);
}

/// The dot product, always summed in this order.
inline float dot3(float ax, float ay, float az, float bx, float by, float bz)
{
  return ax * bx + ay * by + az * bz;
}

/// Keys and alphas (pairAlpha) of the pairs of a reference point with each of some points.
/// @param keys    One a point; kNoKey for a pair longer than the diameter and for points in one
///                place.
/// @param alphas  One a point, in [0, 65535].
void pairKeys(const PointArrays& points, const PairReference& reference, const KeySteps& steps,
              std::uint32_t* keys, std::uint32_t* alphas);
}  // namespace ppf_bin_picking
