/// @file Measures what each sensor preset makes of a flat plate and of a sphere, and prints the
/// tables of docs/simulator.md. Given a part and a folder, it also takes each preset's picture of a
/// bin of 40 parts, and its time.
#include "ppf_bin_picking/core/normals.hpp"

#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "support/shapes.hpp"

#include <opencv2/imgcodecs.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kSphereRadius_m = 0.05F;
constexpr float kHalfPlate_m = 0.08F;
constexpr double kGap_m = 0.2;  // from the target to the wall behind it
constexpr int kPartsInBin = 40;

/// What a preset makes of the pixels that look at a target.
struct Measurement
{
  double rms_m = 0;    ///< Standard deviation about the truth, flying pixels aside.
  double bias_m = 0;   ///< Mean error, flying pixels aside.
  double missing = 0;  ///< Share of the pixels.
  double flying = 0;   ///< Share of the measured pixels.
};

/// The plate turned about the image's x axis, or the sphere (slant_deg < 0), before a wall.
Measurement measure(const DepthSensor& sensor, double distance_m, double slant_deg)
{
  const bool is_sphere = slant_deg < 0;
  const TriangleMesh target = is_sphere ? sphereMesh(kSphereRadius_m) : squareMesh(kHalfPlate_m);
  const TriangleMesh wall = squareMesh(2);
  Eigen::Isometry3d T_camera_target(
      Eigen::Translation3d(0, 0, distance_m + (is_sphere ? kSphereRadius_m : 0)));
  if (!is_sphere)
    T_camera_target.rotate(Eigen::AngleAxisd(slant_deg * M_PI / 180, Eigen::Vector3d::UnitX()));
  const Eigen::Isometry3d T_camera_wall(Eigen::Translation3d(0, 0, distance_m + kGap_m));
  const RayCaster world({{&target, T_camera_target}, {&wall, T_camera_wall}});
  const auto shot = [&](const DepthSensor& kind)
  { return takeShot(world, kind, Eigen::Isometry3d::Identity(), 1); };

  DepthSensor faultless;
  faultless.camera = sensor.camera;
  DepthSensor without_flying = sensor;  // chance deals alike to the pixels that do not fly
  without_flying.flying_share = 0;
  const DepthView truth = shot(faultless), calm = shot(without_flying), full = shot(sensor);
  double pixels = 0, measured = 0, flying = 0;
  Measurement result;
  for (std::size_t pixel = 0; pixel < truth.object.size(); ++pixel)
  {
    if (truth.object[pixel] != 0) continue;
    ++pixels;
    const double depth = calm.cloud_camera.points[pixel].z();
    if (!std::isfinite(depth)) continue;
    ++measured;
    flying += calm.cloud_camera.points[pixel] != full.cloud_camera.points[pixel];
    const double error = depth - truth.cloud_camera.points[pixel].z();
    result.bias_m += error;
    result.rms_m += error * error;
  }
  result.bias_m /= measured;
  result.rms_m = std::sqrt(result.rms_m / measured);
  result.missing = 1 - measured / pixels;
  result.flying = flying / measured;
  return result;
}

void printParameters()
{
  std::vector<std::string> rows;
  visitSensorFields(DepthSensor(), [&](const char* name, const auto&, double, double)
                    { rows.push_back("| `" + std::string(name) + "` |"); });
  std::printf("| parameter |");
  for (const std::string& preset : sensorPresetNames())
  {
    std::printf(" %s |", preset.c_str());
    std::size_t row = 0;
    visitSensorFields(sensorPreset(preset),
                      [&](const char*, auto value, double, double)
                      {
                        char text[40];
                        std::snprintf(text, sizeof text, " %.6g |", static_cast<double>(value));
                        rows[row++] += text;
                      });
  }
  std::printf("\n|---|---|---|---|\n");
  for (const std::string& row : rows)
    std::printf("%s\n", row.c_str());
}

void printMeasurements()
{
  std::printf("\n| preset | target | at | std [mm] | bias [mm] | missing | flying |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const std::string& preset : sensorPresetNames())
    for (const double distance_m : {0.6, 1.0})
      for (const int slant_deg : {0, 45, 70, -1})
      {
        const Measurement m = measure(sensorPreset(preset), distance_m, slant_deg);
        const std::string target =
            slant_deg < 0 ? "sphere" : "plate, " + std::to_string(slant_deg) + " deg";
        std::printf("| %s | %s | %.1f m | %.3f | %.3f | %.1f %% | %.2f %% |\n", preset.c_str(),
                    target.c_str(), distance_m, 1000 * m.rms_m, 1000 * m.bias_m, 100 * m.missing,
                    100 * m.flying);
      }
}

/// Bright where it faces the upper left, blue where nothing was measured.
cv::Mat relief(const DepthView& view, const PinholeCamera& camera)
{
  RangeImage image;
  image.camera = camera;
  for (const Eigen::Vector3f& point : view.cloud_camera.points)
    image.depth.push_back(std::isfinite(point.z()) ? point.z() : 0);
  estimateImageNormals(image, 1, 0.005F, 0);
  const Eigen::Vector3f light = Eigen::Vector3f(-0.5F, -0.5F, -1).normalized();
  cv::Mat picture(camera.height, camera.width, CV_8UC3, cv::Scalar(90, 30, 0));
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
    {
      const std::size_t pixel = image.index(u, v);
      if (image.depth[pixel] == 0) continue;
      const float facing = std::max(0.0F, image.normals[pixel].dot(light));
      const int level = static_cast<int>(13 * facing);  // few, so that the file stays small
      picture.at<cv::Vec3b>(v, u) = cv::Vec3b::all(static_cast<unsigned char>(40 + 16 * level));
    }
  return picture;
}

/// Takes each preset's picture of the same bin, and the time of the shot.
void takePictures(const std::string& part_file, const std::string& folder)
{
  const auto part = loadPart(part_file);
  const TriangleMesh mesh = loadMesh(part.mesh_file, part.unit).mesh;
  const CellSettings settings;
  SimulatedCell cell(settings, {mesh, convexHulls(mesh), part.symmetries()}, 1);
  cell.refill(kPartsInBin);
  const TriangleMesh bin = binMesh(settings.bin);
  std::vector<PlacedMesh> meshes = {{&bin, cell.T_base_bin()}};
  for (const Eigen::Isometry3d& T_base_part : cell.parts())
    meshes.push_back({&mesh, T_base_part});
  const RayCaster world(meshes);
  std::printf("\n%d parts of %s\n", kPartsInBin, part.model_id.c_str());
  for (const std::string& preset : sensorPresetNames())
  {
    const DepthSensor sensor = sensorPreset(preset);
    const auto start = std::chrono::steady_clock::now();
    const DepthView view = takeShot(world, sensor, cell.T_base_camera(), 1);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::printf("%s: %d x %d in %.2f s\n", preset.c_str(), sensor.camera.width,
                sensor.camera.height, time.count());
    cv::imwrite(folder + "/" + preset + ".png", relief(view, sensor.camera),
                {cv::IMWRITE_PNG_COMPRESSION, 9});
  }
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  if (argc != 1 && argc != 3)
  {
    std::fprintf(stderr, "usage: measure_camera [PART.yaml FOLDER_FOR_PICTURES]\n");
    return 2;
  }
  try
  {
    ppf_bin_picking::printParameters();
    ppf_bin_picking::printMeasurements();
    if (argc == 3) ppf_bin_picking::takePictures(argv[1], argv[2]);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
