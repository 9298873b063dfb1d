#include "ppf_bin_picking/core/alignment_kernel.hpp"

#include "instruction_sets.hpp"
#include "lanes.hpp"

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
struct Vectors
{
  Floats x, y, z;
};

PPF_BIN_PICKING_INLINE Floats dot(const Vectors& a, const Vectors& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

PPF_BIN_PICKING_INLINE Vectors turned(const RigidMotion& motion, const Vectors& v)
{
  const auto& r = motion.rotation;
  return {r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z,
          r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z,
          r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z};
}

/// Some samples in their own frame; those beyond the last are the first again.
struct Samples
{
  Samples(const PointArrays& all, std::size_t first)
      : count(std::min<std::size_t>(kLanes, all.size() - first))
  {
    const auto take = [&](const std::vector<float>& from)
    {
      if (count == kLanes) return load(&from[first]);
      Floats values{};
      for (std::size_t k = 0; k < kLanes; ++k)
        values[k] = from[first + (k < count ? k : 0)];
      return values;
    };
    points = {take(all.x), take(all.y), take(all.z)};
    normals = {take(all.nx), take(all.ny), take(all.nz)};
  }

  std::size_t count;
  Vectors points;
  Vectors normals;
};

/// What the image shows where some points fall.
struct Measured
{
  Vectors points;
  Vectors normals;
  Integers known;
};

PPF_BIN_PICKING_INLINE Measured lookUp(const ImageArrays& image, const Vectors& p)
{
  const Floats u = image.fx * p.x / p.z + image.cx, v = image.fy * p.y / p.z + image.cy;
  const Integers inside = (p.z > 0) & (u > -0.5F) & (u < static_cast<float>(image.width) - 0.5F) &
                          (v > -0.5F) & (v < static_cast<float>(image.height) - 0.5F);
  const Integers column = inside & __builtin_convertvector(u + 0.5F, Integers);
  const Integers row = inside & __builtin_convertvector(v + 0.5F, Integers);
  Floats z{};
  Measured measured{};
  for (int k = 0; k < kLanes; ++k)
  {
    const std::size_t pixel =
        static_cast<std::size_t>(row[k]) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(column[k]);
    const float* const normal = image.normals + 3 * pixel;
    z[k] = image.depth_m[pixel];
    measured.normals.x[k] = normal[0];
    measured.normals.y[k] = normal[1];
    measured.normals.z[k] = normal[2];
  }
  measured.known = inside & (z > 0);
  measured.points = {z * (__builtin_convertvector(column, Floats) - image.cx) / image.fx,
                     z * (__builtin_convertvector(row, Floats) - image.cy) / image.fy, z};
  return measured;
}

PPF_BIN_PICKING_INLINE float sumOf(Floats values)
{
  float sum = 0;
  for (int k = 0; k < kLanes; ++k)
    sum += values[k];
  return sum;
}
}  // namespace

PPF_BIN_PICKING_CLONES
void sumAlignment(const PointArrays& samples, const ImageArrays& image,
                  const RigidMotion& T_camera_samples, const AlignmentTerms& terms,
                  AlignmentSums& sums)
{
  const auto& shift = T_camera_samples.shift_m;
  Floats squares[21]{}, right_side[6]{}, weights{};
  for (std::size_t first = 0; first < samples.size(); first += kLanes)
  {
    const Samples some(samples, first);
    const Vectors arm_m = turned(T_camera_samples, some.points);
    const Vectors p{arm_m.x + shift[0], arm_m.y + shift[1], arm_m.z + shift[2]};
    const Measured measured = lookUp(image, p);
    const Vectors& n = measured.normals;
    const Floats residual =
        dot(n, {measured.points.x - p.x, measured.points.y - p.y, measured.points.z - p.z});
    const Floats cosine = dot(n, turned(T_camera_samples, some.normals));
    const Floats share = residual / terms.gate_m;
    const Integers fits = measured.known & (cosine >= terms.min_normal_cosine) &
                          (magnitude(share) < 1) &
                          (kLaneNumbers < static_cast<std::int32_t>(some.count));
    const Floats weight = where(fits, (1 - share * share) * (1 - share * share));
    const Vectors arm{(p.x - terms.center_m[0]) / terms.lever_m,
                      (p.y - terms.center_m[1]) / terms.lever_m,
                      (p.z - terms.center_m[2]) / terms.lever_m};
    const Floats jacobian[6] = {arm.y * n.z - arm.z * n.y,
                                arm.z * n.x - arm.x * n.z,
                                arm.x * n.y - arm.y * n.x,
                                n.x,
                                n.y,
                                n.z};
    int next = 0;
    for (int i = 0; i < 6; ++i)
    {
      const Floats weighted = weight * jacobian[i];
      right_side[i] += weighted * residual;
      for (int j = i; j < 6; ++j)
        squares[next++] += weighted * jacobian[j];
    }
    weights += weight;
  }
  for (int i = 0; i < 21; ++i)
    sums.squares[i] = sumOf(squares[i]);
  for (int i = 0; i < 6; ++i)
    sums.right_side[i] = sumOf(right_side[i]);
  sums.weight = sumOf(weights);
}
}  // namespace ppf_bin_picking
