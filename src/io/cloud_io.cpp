#include "ppf_bin_picking/io/cloud_io.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include "cloud_check.hpp"
#include "cloud_header.hpp"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxCloudBytes = std::size_t{1} << 31;
constexpr float kNear_m = 0.05F;
constexpr float kFar_m = 20;

/// Keeps PCL from printing while it lives.
class QuietPcl
{
public:
  QuietPcl() : level_(pcl::console::getVerbosityLevel())
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

/// What PCL reads from a file.
struct FileCloud
{
  pcl::PCLPointCloud2 blob;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

template <class Reader>
FileCloud readWith(Reader reader, const std::string& path)
{
  const QuietPcl quiet;
  FileCloud file;
  int version = 0;
  int result = -1;
  try
  {
    result = reader.read(path, file.blob, file.origin, file.orientation, version);
  }
  catch (const std::exception&)  // whatever the library throws: the sentence below holds
  {
  }
  const std::size_t points = std::size_t{file.blob.width} * file.blob.height;
  if (result < 0 || file.blob.data.size() < points * file.blob.point_step)
    throw InputError(path + " is damaged or of another kind: write the cloud again");
  return file;
}

FileCloud readFileCloud(const std::string& path, std::size_t max_points)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".pcd" && extension != ".ply")
    throw InputError(path + " is no cloud file by its name: give a .pcd or .ply file");
  const std::string bytes = readFile(path, kMaxCloudBytes);
  const bool is_pcd = extension == ".pcd";
  requireAtMost(max_points, is_pcd ? pcdPoints(bytes, path) : plyPoints(bytes, path), path);
  return is_pcd ? readWith(pcl::PCDReader(), path) : readWith(pcl::PLYReader(), path);
}

/// Offset in bytes of a float field; -1 if there is none.
int floatField(const pcl::PCLPointCloud2& blob, const std::string& name)
{
  for (const pcl::PCLPointField& field : blob.fields)
  {
    const bool fits = field.datatype == pcl::PCLPointField::FLOAT32 && field.count <= 1 &&
                      field.offset + sizeof(float) <= blob.point_step;
    if (field.name == name && fits) return static_cast<int>(field.offset);
  }
  return -1;
}

/// The vectors of three fields, one for each point; empty if one of the fields is missing.
std::vector<Eigen::Vector3f> vectors(const pcl::PCLPointCloud2& blob,
                                     const std::array<const char*, 3>& names)
{
  std::array<int, 3> offsets{};
  for (std::size_t k = 0; k < 3; ++k)
    offsets[k] = floatField(blob, names[k]);
  if (std::count(offsets.begin(), offsets.end(), -1) > 0) return {};
  std::vector<Eigen::Vector3f> result(std::size_t{blob.width} * blob.height);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      std::memcpy(&result[i][static_cast<Eigen::Index>(k)],
                  &blob.data[i * blob.point_step + static_cast<std::size_t>(offsets[k])],
                  sizeof(float));
  return result;
}

/// Median of the finite points' distances from the camera [m].
float medianDistance(const PointCloud& cloud)
{
  std::vector<float> distances;
  for (const Eigen::Vector3f& p : cloud.points)
    if (p.allFinite()) distances.push_back(p.norm());
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

std::vector<std::string> warningsOf(const FileCloud& file, const PointCloud& cloud,
                                    const std::string& path)
{
  std::vector<std::string> warnings;
  const float distance_m = medianDistance(cloud);
  if (!(distance_m > kNear_m && distance_m < kFar_m))
    warnings.push_back(path + " has its points " + std::to_string(distance_m) +
                       " m from the camera: check that its unit is as stated");
  if (file.origin.head<3>().norm() > 0)
    warnings.push_back(path +
                       " names a viewpoint off its origin, which is not looked at: give the "
                       "points in the camera's own frame");
  return warnings;
}
}  // namespace

LoadedCloud loadCloud(const std::string& path, LengthUnit unit, std::size_t max_points)
{
  const FileCloud file = readFileCloud(path, max_points);
  LoadedCloud loaded;
  PointCloud& cloud = loaded.cloud;
  cloud.width = file.blob.width;
  cloud.height = file.blob.height;
  cloud.points = vectors(file.blob, {"x", "y", "z"});
  if (cloud.points.empty() && cloud.width * cloud.height > 0)
    throw InputError(path + " has no fields x, y, z of type float: write the cloud with them");
  if (unit == LengthUnit::kMillimetre)
    for (Eigen::Vector3f& p : cloud.points)
      p *= static_cast<float>(metres(unit));
  cloud.normals = vectors(file.blob, {"normal_x", "normal_y", "normal_z"});
  requireMeasurement(cloud, path);
  loaded.warnings = warningsOf(file, cloud, path);
  return loaded;
}
}  // namespace ppf_bin_picking
