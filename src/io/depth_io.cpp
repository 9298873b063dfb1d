#include "ppf_bin_picking/io/depth_io.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include "cloud_check.hpp"
#include "png_check.hpp"

#include <opencv2/imgcodecs.hpp>

#include <limits>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxImageBytes = std::size_t{1} << 28;

void checkImage(const PngHeader& image, const std::string& path, const DepthCamera& camera)
{
  if (!image.damage.empty())
    throw InputError(path + " cannot be used (" + image.damage +
                     "): give a whole 16-bit grey PNG depth image");
  if (image.bit_depth != 16 || image.color_type != 0)
    throw InputError(path + " is a PNG of another kind: give a 16-bit grey one, the depth image");
  const auto size = [](std::int64_t width, std::int64_t height)
  { return std::to_string(width) + " x " + std::to_string(height); };
  if (image.width != static_cast<std::uint32_t>(camera.pinhole.width) ||
      image.height != static_cast<std::uint32_t>(camera.pinhole.height))
    throw InputError(
        path + " has " + size(image.width, image.height) + " pixels but its camera file says " +
        size(camera.pinhole.width, camera.pinhole.height) + ": give the camera file of this image");
}

Eigen::Vector3f pointAt(int u, int v, std::uint16_t level, const DepthCamera& camera)
{
  const float z = level == 0 ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>(level) * camera.depth_unit_m;
  const PinholeCamera& c = camera.pinhole;
  return {(static_cast<float>(u) - c.cx) / c.fx * z, (static_cast<float>(v) - c.cy) / c.fy * z, z};
}
}  // namespace

DepthCamera loadDepthCamera(const std::string& path)
{
  const YamlMap map(loadYaml(path), path,
                    {"width", "height", "fx", "fy", "cx", "cy", "depth_unit_m", "frame_id"});
  const auto positive = [&](const char* key, double value)
  {
    if (!(static_cast<float>(value) > 0))
      throw InputError(path + ": " + key + " is " + plainDecimal(value) + ": give one above 0");
    return value;
  };
  const auto single = [&](const char* key) { return static_cast<float>(map.number(key)); };
  DepthCamera camera;
  camera.pinhole.width = static_cast<int>(positive("width", map.integer("width")));
  camera.pinhole.height = static_cast<int>(positive("height", map.integer("height")));
  camera.pinhole.fx = static_cast<float>(positive("fx", map.number("fx")));
  camera.pinhole.fy = static_cast<float>(positive("fy", map.number("fy")));
  camera.pinhole.cx = single("cx");
  camera.pinhole.cy = single("cy");
  camera.depth_unit_m = static_cast<float>(positive("depth_unit_m", map.number("depth_unit_m")));
  camera.frame_id = map.text("frame_id");
  return camera;
}

PointCloud loadDepthCloud(const std::string& path, const DepthCamera& camera,
                          std::size_t max_points)
{
  const std::string bytes = readFile(path, kMaxImageBytes);
  checkImage(checkPng(bytes), path, camera);
  PointCloud cloud;
  cloud.width = static_cast<std::size_t>(camera.pinhole.width);
  cloud.height = static_cast<std::size_t>(camera.pinhole.height);
  requireAtMost(max_points, cloud.width * cloud.height, path);
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  const cv::Mat image = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1 || image.cols != camera.pinhole.width ||
      image.rows != camera.pinhole.height)
    throw InputError(path + " cannot be decoded: give a whole 16-bit grey PNG depth image");
  cloud.points.reserve(cloud.width * cloud.height);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      cloud.points.push_back(pointAt(u, v, image.at<std::uint16_t>(v, u), camera));
  requireMeasurement(cloud, path);
  return cloud;
}
}  // namespace ppf_bin_picking
