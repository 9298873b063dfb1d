/// @file Random numbers that are the same everywhere.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <random>

namespace ppf_bin_picking
{
/// A seeded source. The standard fixes std::mt19937 but not its distributions, so these are our
/// own: the same seed gives the same scene whatever the library.
class Random
{
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// In [low, high).
  double uniform(double low, double high);

  /// In [0, count). @param count  >= 1.
  int below(int count);

  /// Mean 0, standard deviation 1.
  double normal();

  /// Unit length, every direction alike.
  Eigen::Vector3d direction();

private:
  std::mt19937 engine_;
};
}  // namespace ppf_bin_picking
