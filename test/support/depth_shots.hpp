/// @file Shots of simple scenes whose depth a formula gives.
#pragma once

#include "ppf_bin_picking/sim/depth_camera.hpp"

#include "support/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// No faults, a small image.
inline DepthSensor smallSensor()
{
  DepthSensor sensor;
  sensor.camera = {320, 240, 560, 560, 159.5, 119.5};
  return sensor;
}

/// A wide square at a distance along the camera's axis, turned about its x axis (down the image it
/// comes nearer), seen from the world's origin.
struct Plate
{
  double distance_m;
  double slant_rad;

  DepthView shot(const DepthSensor& sensor, std::uint32_t seed = 1) const
  {
    const TriangleMesh square = squareMesh(5);
    Eigen::Isometry3d T_camera_plate(Eigen::Translation3d(0, 0, distance_m));
    T_camera_plate.rotate(Eigen::AngleAxisd(-slant_rad, Eigen::Vector3d::UnitX()));
    const RayCaster world({{&square, T_camera_plate}});
    return takeShot(world, sensor, Eigen::Isometry3d::Identity(), seed);
  }

  /// Depth at a place in the image.
  double depth(const PinholeCamera& camera, double v) const
  {
    return distance_m / (1 + std::tan(slant_rad) * (v - camera.cy) / camera.fy);
  }
};

/// A box of 40 x 40 x 50 mm on a floor 0.6 m below the camera, which looks straight down.
struct BoxOnFloor
{
  TriangleMesh floor = squareMesh(2);
  TriangleMesh box = boxMesh({0.04F, 0.04F, 0.05F});
  RayCaster world{{{&floor, Eigen::Isometry3d::Identity()},
                   {&box, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.025))}}};
  Eigen::Isometry3d T_world_camera = lookAt({0, 0, 0.6}, {0, 0, 0});

  DepthView shot(const DepthSensor& sensor, std::uint32_t seed = 1) const
  {
    return takeShot(world, sensor, T_world_camera, seed);
  }
};

/// Number of pixels with a measurement.
inline int measured(const DepthView& view)
{
  return static_cast<int>(std::count_if(view.cloud_camera.points.begin(),
                                        view.cloud_camera.points.end(),
                                        [](const Eigen::Vector3f& p) { return p.allFinite(); }));
}

/// Depth measured by a pixel [m]; NaN if none.
inline float depthAt(const DepthView& view, int column, int row)
{
  return view.cloud_camera.points[static_cast<std::size_t>(row) * view.cloud_camera.width + column]
      .z();
}

/// Mean and standard deviation.
struct Spread
{
  double mean = 0;
  double std = 0;
  int count = 0;

  explicit Spread(const std::vector<double>& values) : count(static_cast<int>(values.size()))
  {
    for (const double value : values)
      mean += value / count;
    for (const double value : values)
      std += (value - mean) * (value - mean) / count;
    std = std::sqrt(std);
  }
};
}  // namespace ppf_bin_picking
