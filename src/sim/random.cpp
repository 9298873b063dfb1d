#include "ppf_bin_picking/sim/random.hpp"

#include <cmath>

namespace ppf_bin_picking
{
double Random::uniform(double low, double high)
{
  return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
}

int Random::below(int count)
{
  return static_cast<int>(uniform(0, count));
}

double Random::normal()
{
  const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
  return radius * std::cos(uniform(0, 2 * M_PI));
}

Eigen::Vector3d Random::direction()
{
  const double z = uniform(-1, 1);
  const double angle_rad = uniform(0, 2 * M_PI);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle_rad), radius * std::sin(angle_rad), z};
}
}  // namespace ppf_bin_picking
