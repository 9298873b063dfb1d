#include "cloud_check.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>

namespace ppf_bin_picking
{
void requireAtMost(std::size_t max_points, std::size_t points, const std::string& path)
{
  if (points > max_points)
    throw InputError(path + " holds " + std::to_string(points) + " points, more than max_points (" +
                     std::to_string(max_points) + "): thin it out or raise max_points");
}

void requireMeasurement(const PointCloud& cloud, const std::string& path)
{
  if (std::none_of(cloud.points.begin(), cloud.points.end(), measured))
    throw InputError(path + " holds no measured point in front of the camera (" +
                     std::to_string(cloud.size()) +
                     " in all): check the camera, that z points forward, the unit, and that it is "
                     "the file you mean");
}
}  // namespace ppf_bin_picking
