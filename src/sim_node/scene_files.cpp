#include "scene_files.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/rigid_pose.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace ppf_bin_picking
{
namespace fs = std::filesystem;
namespace
{
using nlohmann::json;
constexpr double kFineUnit_m = 0.00002;  // reaches 1.3 m in 16 bits
constexpr double kCoarseUnit_m = 0.0002;
constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;
constexpr double kWallGap_m = 0.002;   // of the region of interest
constexpr double kFloorGap_m = 0.003;  // of the region of interest
constexpr double kGoldenShare = 0.618034;
constexpr int kJpegQuality = 85;
const char* const kFrame = "camera_optical_frame";

double depthUnit(const PointCloud& cloud)
{
  float farthest = 0;
  for (const Eigen::Vector3f& point : cloud.points)
    if (point.z() > farthest) farthest = point.z();
  const bool fits = farthest < kFineUnit_m * std::numeric_limits<std::uint16_t>::max();
  return fits ? kFineUnit_m : kCoarseUnit_m;
}

std::string encoded(const std::string& extension, const cv::Mat& image,
                    const std::vector<int>& parameters = {})
{
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

cv::Size imageSize(const PointCloud& cloud)
{
  return {static_cast<int>(cloud.width), static_cast<int>(cloud.height)};
}

cv::Mat depthImage(const PointCloud& cloud, double unit_m)
{
  cv::Mat image(imageSize(cloud), CV_16UC1);
  auto level = image.begin<std::uint16_t>();
  for (const Eigen::Vector3f& point : cloud.points)
    *level++ = cv::saturate_cast<std::uint16_t>(std::isfinite(point.z()) ? point.z() / unit_m : 0);
  return image;
}

/// Grey where the bin is, a colour for each part.
cv::Mat preview(const DepthView& view)
{
  cv::Mat image(imageSize(view.cloud_camera), CV_32FC3);
  auto color = image.begin<cv::Vec3f>();
  for (std::size_t pixel = 0; pixel < view.cloud_camera.size(); ++pixel, ++color)
  {
    const bool measured = std::isfinite(view.cloud_camera.points[pixel].z());
    const int object = view.object[pixel];
    const double turn = kGoldenShare * object;
    const auto hue_deg = static_cast<float>(360 * (turn - std::floor(turn)));
    *color = {hue_deg, object > 0 ? 0.55F : 0.0F, measured ? view.brightness[pixel] : 0.0F};
  }
  cv::cvtColor(image, image, cv::COLOR_HSV2BGR);
  image.convertTo(image, CV_8UC3, 255);
  return image;
}

std::string cameraYaml(const PinholeCamera& camera, double unit_m)
{
  std::ostringstream text;
  text << "width: " << camera.width << "\nheight: " << camera.height;
  for (const auto& [key, value] : {std::pair<const char*, double>("fx", camera.fx),
                                   {"fy", camera.fy},
                                   {"cx", camera.cx},
                                   {"cy", camera.cy},
                                   {"depth_unit_m", unit_m}})
    text << "\n" << key << ": " << plainDecimal(value);
  text << "\nframe_id: " << kFrame << "\n";
  return text.str();
}

template <class Numbers>
std::string yamlList(const Numbers& numbers)
{
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "[" : ", ") + plainDecimal(number);
  return text + "]";
}

/// The inside of the bin without its walls and floor, and as far above its rim as it is deep: parts
/// may be heaped.
std::string roiYaml(const Eigen::Isometry3d& T_camera_bin, const Eigen::Vector3d& size_m)
{
  const double x = size_m.x() / 2 - kWallGap_m;
  const double y = size_m.y() / 2 - kWallGap_m;
  return "pose: " + yamlList(rowMajor(T_camera_bin)) +
         "\nmin: " + yamlList(std::array<double, 3>{-x, -y, kFloorGap_m}) +
         "\nmax: " + yamlList(std::array<double, 3>{x, y, 2 * size_m.z()}) + "\n";
}

std::string truthJson(const std::vector<PartTruth>& parts, const Eigen::Isometry3d& T_camera_bin,
                      const Eigen::Vector3d& size_m)
{
  json objects = json::array();
  for (const PartTruth& part : parts)
    objects.push_back(
        {{"pose", rowMajor(part.T_camera_model)}, {"visibility", part.visible_share}});
  const json root = {
      {"objects", objects},
      {"bin", {{"pose", rowMajor(T_camera_bin)}, {"size", {size_m.x(), size_m.y(), size_m.z()}}}}};
  return root.dump() + "\n";
}
/// Paths and contents of a data set's part; nothing where the part file is the data set's own.
std::map<std::string, std::string> partFiles(const std::string& folder, const PartDescription& part)
{
  const std::string part_file = folder + "/part.yaml";
  std::error_code none;  // of a part file that does not exist
  if (fs::equivalent(part_file, part.source, none)) return {};
  const std::string mesh = "model" + fs::path(part.mesh_file).extension().string();
  YAML::Node yaml = loadYaml(part.source);
  yaml["mesh"] = mesh;
  std::ostringstream text;
  text << yaml << "\n";
  return {{part_file, text.str()}, {folder + "/" + mesh, readFile(part.mesh_file, kMaxMeshBytes)}};
}
}  // namespace

void makeFolder(const std::string& path)
{
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path))
    throw InputError(path + " cannot be made: give a folder that can be written");
}

void requireSamePart(const std::string& folder, const PartDescription& part)
{
  for (const auto& [path, bytes] : partFiles(folder, part))
    if (fs::exists(path) && readFile(path, kMaxMeshBytes) != bytes)
      throw InputError(path + " belongs to another part, or to another state of this one: give " +
                       "another output, or remove the folder");
}

void writePart(const std::string& folder, const PartDescription& part)
{
  makeFolder(folder);
  for (const auto& [path, bytes] : partFiles(folder, part))
    writeFile(path, bytes);
}

void writeScene(const std::string& folder, const SceneShot& shot)
{
  makeFolder(folder);
  const Eigen::Isometry3d T_camera_bin = shot.T_bin_camera.inverse();
  const Eigen::Vector3d& size_m = shot.cell.bin.size_m;
  const double unit_m = depthUnit(shot.view.cloud_camera);
  writeFile(folder + "/depth.png", encoded(".png", depthImage(shot.view.cloud_camera, unit_m)));
  writeFile(folder + "/camera.yaml", cameraYaml(shot.cell.sensor.camera, unit_m));
  writeFile(folder + "/roi.yaml", roiYaml(T_camera_bin, size_m));
  writeFile(folder + "/preview.jpg",
            encoded(".jpg", preview(shot.view), {cv::IMWRITE_JPEG_QUALITY, kJpegQuality}));
  writeFile(folder + "/gt.json", truthJson(shot.parts, T_camera_bin, size_m));
}
}  // namespace ppf_bin_picking
