#include "ppf_bin_picking/sim/depth_sensor.hpp"

#include <sstream>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
/// With the figures given for the Photoneo PhoXi 3D Scanner M, best at 650 mm: baseline 270 mm and
/// a "temporal noise" of 0.1 mm (one standard deviation, on a matt surface). Its camera and
/// projector are turned by 11.75 degrees each, which agrees: 2 * 650 mm * tan(11.75 deg) = 270 mm.
/// The noise at 1 m is 0.1 mm / 0.65^2. The rest has no source: chosen so that pictures look like
/// scans of such devices.
DepthSensor industrial()
{
  DepthSensor sensor;
  sensor.baseline_m = 0.27;
  sensor.max_slant_rad = 1.4;
  sensor.glare_rad = 0.03;
  sensor.flying_share = 0.05;
  sensor.flying_reach_px = 1;
  sensor.noise_at_1m_m = 0.00024;
  sensor.lateral_noise_px = 0.1;
  sensor.depth_step_m = 0.00005;
  sensor.dropout_share = 0.002;
  return sensor;
}

/// With the figures given for the Intel RealSense D415: baseline 55 mm, 65 degrees across 1280
/// pixels, of which this is the middle: f = 640 / tan(32.5 deg) = 1005 px; depth in steps of 1 mm.
/// The noise is that of triangulation, z^2 s / (f b), with an error s of the disparity of 0.08 px,
/// as often assumed for these cameras: 1.45 mm at 1 m. The lateral noise of 0.8 px is that of a
/// Kinect, which matches windows of a pattern, too (Nguyen, Izadi, Lovell: Modeling Kinect Sensor
/// Noise, 2012). The rest has no source, as above.
DepthSensor lowCost()
{
  DepthSensor sensor;
  sensor.camera = {640, 480, 1005, 1005, 319.5F, 239.5F};
  sensor.baseline_m = 0.055;
  sensor.max_slant_rad = 1.3;
  sensor.glare_rad = 0.03;
  sensor.flying_share = 0.3;
  sensor.flying_reach_px = 2;
  sensor.noise_at_1m_m = 0.00145;
  sensor.lateral_noise_px = 0.8;
  sensor.depth_step_m = 0.001;
  sensor.dropout_share = 0.01;
  return sensor;
}
}  // namespace

std::vector<std::string> DepthSensor::problems() const
{
  std::vector<std::string> problems;
  visitSensorFields(*this,
                    [&](const char* name, auto value, double low, double high)
                    {
                      if (value >= low && value <= high) return;  // false for NaN, too
                      std::ostringstream text;
                      text << name << " is " << value << ": give a value from " << low << " to "
                           << high;
                      problems.push_back(text.str());
                    });
  return problems;
}

std::vector<std::string> sensorPresetNames()
{
  return {"clean", "industrial", "low_cost"};
}

DepthSensor sensorPreset(const std::string& name)
{
  if (name == "clean") return {};
  if (name == "industrial") return industrial();
  if (name == "low_cost") return lowCost();
  std::string known;
  for (const std::string& preset : sensorPresetNames())
    known += (known.empty() ? "" : ", ") + preset;
  throw std::invalid_argument("there is no sensor preset '" + name + "': give one of " + known);
}
}  // namespace ppf_bin_picking
