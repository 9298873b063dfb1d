#include "ppf_bin_picking/ros/conversions.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace ppf_bin_picking_ros
{
namespace
{
using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;
using FieldNames = std::array<const char*, 3>;

constexpr FieldNames kPointFields = {"x", "y", "z"};
constexpr FieldNames kNormalFields = {"normal_x", "normal_y", "normal_z"};

const PointField* findField(const PointCloud2& cloud, const std::string& name)
{
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  return found == cloud.fields.end() ? nullptr : &*found;
}

std::string fieldProblem(const PointCloud2& cloud, const std::string& name)
{
  const PointField* field = findField(cloud, name);
  const std::string subject = "The cloud's field " + name;
  if (!field)
    return subject + " is missing: publish " +
           (name.size() == 1 ? "x, y and z as FLOAT32"
                             : "normal_x, normal_y and normal_z as FLOAT32, or set "
                               "detector/use_cloud_normals to false");
  if (std::count_if(cloud.fields.begin(), cloud.fields.end(),
                    [&](const PointField& other) { return other.name == name; }) > 1)
    return subject + " is listed more than once: publish it once";
  if (field->datatype != PointField::FLOAT32)
    return subject + " has datatype " + std::to_string(field->datatype) +
           ": publish it as FLOAT32 (7), in metres";
  if (field->count > 1)  // some drivers leave 0 for a single value
    return subject + " has count " + std::to_string(field->count) + ": publish it with count 1";
  if (std::uint64_t{field->offset} + sizeof(float) > cloud.point_step)
    return subject + " ends at byte " + std::to_string(std::uint64_t{field->offset} + 4) +
           ", behind point_step " + std::to_string(cloud.point_step) +
           ": correct its offset or point_step";
  return {};
}

std::string sizeProblem(const PointCloud2& cloud)
{
  const std::uint64_t row_bytes = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.row_step < row_bytes)
    return "The cloud's row_step is " + std::to_string(cloud.row_step) + ", less than width " +
           std::to_string(cloud.width) + " times point_step " + std::to_string(cloud.point_step) +
           ": correct row_step";
  const std::uint64_t bytes = std::uint64_t{cloud.row_step} * cloud.height;
  if (cloud.data.size() != bytes)
    return "The cloud's data has " + std::to_string(cloud.data.size()) +
           " bytes where row_step times height is " + std::to_string(bytes) +
           ": send whole rows, or correct row_step and height";
  return {};
}

bool hasAnyNormalField(const PointCloud2& cloud)
{
  return std::any_of(kNormalFields.begin(), kNormalFields.end(),
                     [&](const char* name) { return findField(cloud, name) != nullptr; });
}

/// The three fields of each point. The cloud has been checked.
std::vector<Eigen::Vector3f> readVectors(const PointCloud2& cloud, const FieldNames& names)
{
  std::array<std::size_t, 3> offsets;
  for (std::size_t i = 0; i < 3; ++i)
    offsets[i] = findField(cloud, names[i])->offset;
  std::vector<Eigen::Vector3f> vectors;
  vectors.reserve(std::size_t{cloud.width} * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row)
  {
    const std::uint8_t* point = cloud.data.data() + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, point += cloud.point_step)
    {
      Eigen::Vector3f vector;
      for (int i = 0; i < 3; ++i)
        std::memcpy(&vector[i], point + offsets[i], sizeof(float));
      vectors.push_back(vector);
    }
  }
  return vectors;
}
/// The core takes a zero normal for an unknown one.
Eigen::Vector3f unitOrZero(const Eigen::Vector3f& normal)
{
  const float norm = normal.norm();
  if (!(norm > 0.0F) || !std::isfinite(norm)) return Eigen::Vector3f::Zero();
  return normal / norm;
}
}  // namespace

std::string messageProblem(const PointCloud2& cloud, const ppf_bin_picking::DetectorConfig& config)
{
  if (cloud.header.frame_id.empty())
    return "The cloud has no frame: set header.frame_id in the camera's driver";
  if (cloud.is_bigendian)
    return "The cloud is big-endian (is_bigendian is true): publish it little-endian";
  for (const char* name : kPointFields)
    if (const std::string problem = fieldProblem(cloud, name); !problem.empty()) return problem;
  if (config.use_cloud_normals && hasAnyNormalField(cloud))
    for (const char* name : kNormalFields)
      if (const std::string problem = fieldProblem(cloud, name); !problem.empty()) return problem;
  return sizeProblem(cloud);
}

ppf_bin_picking::PointCloud toPointCloud(const PointCloud2& cloud,
                                         const ppf_bin_picking::DetectorConfig& config)
{
  if (const std::string problem = messageProblem(cloud, config); !problem.empty())
    throw std::invalid_argument(problem);
  ppf_bin_picking::PointCloud converted;
  converted.width = cloud.width;
  converted.height = cloud.height;
  converted.points = readVectors(cloud, kPointFields);
  if (config.use_cloud_normals && hasAnyNormalField(cloud))
  {
    converted.normals = readVectors(cloud, kNormalFields);
    for (Eigen::Vector3f& normal : converted.normals)
      normal = unitOrZero(normal);
  }
  return converted;
}

geometry_msgs::PoseWithCovariance toPoseWithCovariance(const Eigen::Isometry3d& T_frame_cloud,
                                                       const Eigen::Isometry3d& T_cloud_model,
                                                       const ppf_bin_picking::Matrix6d& covariance)
{
  ppf_bin_picking::Matrix6d turned = covariance;
  if (covariance(0, 0) >= 0)
  {
    ppf_bin_picking::Matrix6d rotation = ppf_bin_picking::Matrix6d::Zero();
    rotation.topLeftCorner<3, 3>() = T_frame_cloud.linear();
    rotation.bottomRightCorner<3, 3>() = T_frame_cloud.linear();
    turned = rotation * covariance * rotation.transpose();
  }
  geometry_msgs::PoseWithCovariance pose;
  pose.pose = tf2::toMsg(T_frame_cloud * T_cloud_model);
  std::copy(turned.data(), turned.data() + turned.size(), pose.covariance.begin());
  return pose;
}
}  // namespace ppf_bin_picking_ros
