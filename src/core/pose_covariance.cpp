#include "ppf_bin_picking/core/pose_covariance.hpp"

#include "ppf_bin_picking/core/boundary_table.hpp"
#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/outline.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kMinFacing = 0.25F;        // surfaces flatter to the line of sight are left out
constexpr int kReach_px = 5;               // across the outline, as the refinement ends
constexpr int kBlock_px = 8;               // pixels that err alike lie nearer than that
constexpr double kLeastError_px = 0.3;     // of the outline: it is found in whole pixels
constexpr double kLeastErrorRel = 0.0005;  // of the surface, of the diameter
// Variance that the residuals do not show: what a whole face errs alike, the fit takes up. From the
// true errors of 36 simulated scenes (12 parts, 3 sensors, seed 101).
constexpr double kUnseenShare = 8;
constexpr double kShadowWeight = 0.3;  // of an end beyond which nothing was measured

/// What measurements of one kind say of small motions, in levers, and how well they agree.
class Measurements
{
public:
  explicit Measurements(const RenderedPart& view)
      : left_(view.left),
        top_(view.top),
        columns_(view.width / kBlock_px + 1),
        blocks_(static_cast<std::size_t>(columns_) *
                static_cast<std::size_t>(view.height / kBlock_px + 1))
  {
  }

  /// (u, v): a pixel of the view.
  void add(const Vector6f& jacobian, double residual_m, int u, int v, double weight = 1)
  {
    const Eigen::Matrix<double, 6, 1> j = jacobian.cast<double>();
    information_ += weight * j * j.transpose();
    squares_ += weight * residual_m * residual_m;
    weights_ += weight;
    const int block = (v - top_) / kBlock_px * columns_ + (u - left_) / kBlock_px;
    blocks_[static_cast<std::size_t>(block)] += weight * residual_m;
  }

  /// Information [1 / m^2] of as many measurements as err independently.
  /// @param least_m  Their standard deviation is at least that.
  Matrix6d information(double least_m) const
  {
    if (!(weights_ > 0)) return Matrix6d::Zero();
    const double variance = std::max(squares_ / weights_, least_m * least_m);
    double sums = 0;
    for (const double block : blocks_)
      sums += block * block;
    const double alike = squares_ > 0 ? std::max(1.0, sums / squares_) : 1.0;
    return information_ / (variance * alike * kUnseenShare);
  }

private:
  Matrix6d information_ = Matrix6d::Zero();
  double squares_ = 0;
  double weights_ = 0;
  int left_;
  int top_;
  int columns_;
  std::vector<double> blocks_;  ///< Sums of the residuals.
};

/// Gathers from a part rendered at its pose.
class Gathering
{
public:
  Gathering(const RangeImage& image, const RenderedPart& view, const Eigen::Vector3f& center,
            double diameter_m, const DetectorConfig& config)
      : image_(image),
        view_(view),
        center_(center),
        diameter_m_(static_cast<float>(diameter_m)),
        gate_m_(static_cast<float>(depthGate(image, diameter_m, config))),
        min_normal_cosine_(std::cos(static_cast<float>(config.normal_gate_rad)))
  {
  }

  Measurements surface() const
  {
    Measurements measurements(view_);
    for (int row = 0; row < view_.height; ++row)
      for (int column = 0; column < view_.width; ++column)
        if (view_.depthAt(column, row) > 0) addPixel(column, row, measurements);
    return measurements;
  }

  Measurements outline() const
  {
    Measurements measurements(view_);
    for (const OutlinePoint& point :
         outlineOf(view_, image_.camera, boundaryJump(diameter_m_), kReach_px, 1))
    {
      const OutlineMatch match = matchOutline(image_, point, point.point, gate_m_, kReach_px);
      if (match.end != OutlineEnd::kBehind && match.end != OutlineEnd::kMissing) continue;
      const Eigen::Vector3f direction(point.direction.x(), point.direction.y(), 0);
      const Eigen::Vector2f pixel = image_.camera.project(point.point);
      measurements.add(motionJacobian(armTo(point.point), direction),
                       static_cast<float>(match.offset_px) * point.point.z() / image_.camera.fx,
                       static_cast<int>(pixel.x()), static_cast<int>(pixel.y()),
                       match.end == OutlineEnd::kBehind ? 1.0 : kShadowWeight);
    }
    return measurements;
  }

private:
  Eigen::Vector3f armTo(const Eigen::Vector3f& point) const
  {
    return (point - center_) / (kLeverRel * diameter_m_);
  }

  void addPixel(int column, int row, Measurements& measurements) const
  {
    const int u = view_.left + column, v = view_.top + row;
    const std::size_t index = image_.index(u, v);
    const Eigen::Vector3f ray = image_.camera.ray(static_cast<float>(u), static_cast<float>(v));
    Eigen::Vector3f normal =
        view_.normals[view_.triangle[static_cast<std::size_t>(row) * view_.width + column]];
    if (normal.dot(ray) > 0) normal = -normal;
    const float facing = -normal.dot(ray) / ray.norm();
    const float depth_m = view_.depthAt(column, row);
    const float behind_m = (image_.depth[index] - depth_m) * ray.norm() * facing;
    if (facing < kMinFacing || image_.depth[index] == 0 || std::abs(behind_m) > gate_m_ ||
        !image_.in_roi[index])
      return;
    const Eigen::Vector3f& measured = image_.normals[index];
    if (!measured.isZero() && measured.dot(normal) < min_normal_cosine_) return;
    measurements.add(motionJacobian(armTo(ray * depth_m), normal), behind_m, u, v);
  }

  const RangeImage& image_;
  const RenderedPart& view_;
  Eigen::Vector3f center_;
  float diameter_m_;
  float gate_m_;
  float min_normal_cosine_;
};

/// From turns (in levers) and shifts about the centre to shifts and turns about the origin.
Matrix6d aboutOrigin(const Eigen::Vector3d& center, const Eigen::Vector3d& origin, double lever_m)
{
  const Eigen::Vector3d arm = origin - center;
  Eigen::Matrix3d cross;  // cross * turn = turn x arm
  cross << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  Matrix6d map = Matrix6d::Zero();
  map.topLeftCorner<3, 3>() = cross / lever_m;
  map.topRightCorner<3, 3>() = Eigen::Matrix3d::Identity();
  map.bottomLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / lever_m;
  return map;
}
}  // namespace

Matrix6d poseCovariance(const RangeImage& image, const PpfModel& model,
                        const Eigen::Isometry3d& T_cloud_model, const DetectorConfig& config)
{
  const Eigen::Isometry3f pose = T_cloud_model.cast<float>();
  RenderedPart view;
  renderPart(model.renderable(), pose, image.camera, view);
  const Eigen::Vector3f center = pose * model.data().center;
  const double lever_m = kLeverRel * model.diameter();
  const double pixel_m = center.z() / image.camera.fx;
  const Gathering gathering(image, view, center, model.diameter(), config);
  Matrix6d information = gathering.surface().information(kLeastErrorRel * model.diameter()) +
                         gathering.outline().information(kLeastError_px * pixel_m);
  information += Matrix6d::Identity() / (lever_m * lever_m);
  for (const Vector6f& motion : invisibleMotions(model, pose))
  {  // facets must not hold it
    const Eigen::Matrix<double, 6, 1> unit = motion.cast<double>();
    const Matrix6d rest = Matrix6d::Identity() - unit * unit.transpose();
    information =
        rest * information * rest + 3 / (M_PI * M_PI * lever_m * lever_m) * unit * unit.transpose();
  }
  const Matrix6d map = aboutOrigin(center.cast<double>(), T_cloud_model.translation(), lever_m);
  const Matrix6d covariance = map * information.ldlt().solve(map.transpose());
  return 0.5 * (covariance + covariance.transpose());
}
}  // namespace ppf_bin_picking
