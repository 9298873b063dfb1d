/// @file What a simulated depth camera is like: its image, its projector and its faults.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// A structured-light camera: one pinhole camera, one projector beside it that lights all that the
/// camera can see. An active stereo camera is the same with its second camera for a projector.
///
/// As default-constructed it has no faults: the depth measured is that of the surface. Each fault
/// is off at the value given here, exactly. They apply in the order of the fields.
struct DepthSensor
{
  PinholeCamera camera = {960, 720, 1600, 1600, 479.5F, 359.5F};

  /// The projector's place on the camera's x axis [m]. What it does not light is missing.
  double baseline_m = 0;

  /// Largest angle [rad] between a surface's normal and the ray to the camera, or to the projector.
  /// Flatter surfaces are missing. pi / 2: none is.
  double max_slant_rad = 1.5707963267948966;

  /// A surface is missing if the direction half-way between those to camera and projector is less
  /// than this [rad] away from its normal: there it mirrors the projector into the camera, which is
  /// dazzled. On a shiny part these are a patch of a ball, a line on a cylinder, a whole flat face.
  double glare_rad = 0;

  /// Of the measured pixels near a depth edge, the share that flies: measures a depth somewhere
  /// between the nearest and the farthest surface around it. In [0, 1].
  double flying_share = 0;

  /// How far from a depth edge pixels fly [px]; the pixels on either side of it are at 1.
  int flying_reach_px = 1;

  /// A depth edge lies between two neighbouring pixels, both seen by camera and projector, whose
  /// depths differ by more than this [m].
  double edge_step_m = 0.004;

  /// Standard deviation [m] of the depth of a surface 1 m away that faces the camera. It grows with
  /// the square of the depth, as for every triangulation: z = f b / d, so dz = z^2 / (f b) dd.
  double noise_at_1m_m = 0;

  /// Standard deviation [px] of the place that a pixel looks at. It turns into depth by the slope
  /// of the surface: times 0 facing the camera, times z tan(slant) / f per pixel on a slanted one.
  double lateral_noise_px = 0;

  /// The depth is rounded to a multiple of this [m]. 0: it is not.
  double depth_step_m = 0;

  /// Share of the pixels that measure nothing for no reason. In [0, 1].
  double dropout_share = 0;

  /// One sentence per value out of range; empty means usable.
  std::vector<std::string> problems() const;
};

/// Calls visit(name, field, low, high) for every field, the image's first, each with the range it
/// may have. Fields are int, float or double, the limits double. The names are those in YAML.
template <class Sensor, class Visitor>
void visitSensorFields(Sensor&& sensor, Visitor&& visit)
{
  visit("width", sensor.camera.width, 1.0, 10000.0);
  visit("height", sensor.camera.height, 2.0, 10000.0);
  visit("fx", sensor.camera.fx, 1.0, 100000.0);
  visit("fy", sensor.camera.fy, 1.0, 100000.0);
  visit("cx", sensor.camera.cx, -100000.0, 100000.0);
  visit("cy", sensor.camera.cy, -100000.0, 100000.0);
  visit("baseline_m", sensor.baseline_m, -10.0, 10.0);
  visit("max_slant_rad", sensor.max_slant_rad, 0.0, 1.5707963267948966);
  visit("glare_rad", sensor.glare_rad, 0.0, 1.5707963267948966);
  visit("flying_share", sensor.flying_share, 0.0, 1.0);
  visit("flying_reach_px", sensor.flying_reach_px, 1.0, 10.0);
  visit("edge_step_m", sensor.edge_step_m, 0.0, 10.0);
  visit("noise_at_1m_m", sensor.noise_at_1m_m, 0.0, 1.0);
  visit("lateral_noise_px", sensor.lateral_noise_px, 0.0, 100.0);
  visit("depth_step_m", sensor.depth_step_m, 0.0, 1.0);
  visit("dropout_share", sensor.dropout_share, 0.0, 1.0);
}

/// `clean`, `industrial` and `low_cost`.
std::vector<std::string> sensorPresetNames();

/// - `clean`: no faults.
/// - `industrial`: a structured-light scanner for 0.5 to 1 m.
/// - `low_cost`: an active stereo camera.
/// docs/simulator.md tells where the numbers are from.
/// @throw std::invalid_argument naming the known names.
DepthSensor sensorPreset(const std::string& name);
}  // namespace ppf_bin_picking
