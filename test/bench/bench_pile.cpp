#include "bench_pile.hpp"

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/pose_clustering.hpp"
#include "ppf_bin_picking/core/ppf.hpp"
#include "ppf_bin_picking/core/ppf_matcher.hpp"

#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"

#include "support/synthetic.hpp"

#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr double kStepRel = 0.05;
constexpr double kFloor_m = 0.7;  // along the camera's axis
constexpr int kColumns = 6;
constexpr int kRows = 4;
constexpr double kPitchRel = 0.9;  // of the parts, in diameters
constexpr float kNoise_m = 0.0002F;
constexpr float kPixelsPerDiameter = 110;

DetectorConfig benchConfig()
{
  DetectorConfig config;
  config.model.step_rel = kStepRel;
  config.threads = 1;
  return config;
}

PartDescription describe(const std::string& name)
{
  return loadPart(std::string(PACKAGE_FOLDER) + "/config/parts/" + name + ".yaml");
}

TriangleMesh meshOf(const PartDescription& part)
{
  return loadMesh(part.mesh_file, part.unit).mesh;
}

PinholeCamera cameraFor(double diameter_m)
{
  const float focal_px = kPixelsPerDiameter * static_cast<float>(kFloor_m / diameter_m);
  return {640, 480, focal_px, focal_px, 319.5F, 239.5F};
}

/// T_camera_center of each part: a grid of places, turned at random.
std::vector<Eigen::Isometry3d> places(double diameter_m)
{
  std::mt19937 rng(3);
  std::vector<Eigen::Isometry3d> poses;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
    {
      Eigen::Isometry3d pose = randomPose(rng, 0.1 * diameter_m);
      pose.pretranslate(Eigen::Vector3d((column - 0.5 * (kColumns - 1)) * kPitchRel * diameter_m,
                                        (row - 0.5 * (kRows - 1)) * kPitchRel * diameter_m,
                                        kFloor_m - 0.65 * diameter_m));
      poses.push_back(pose);
    }
  return poses;
}

/// What lies above the floor.
RegionOfInterest aboveFloor(double diameter_m)
{
  RegionOfInterest region;
  region.min = Eigen::Vector3d(-1, -1, 0.1);
  region.max = Eigen::Vector3d(1, 1, kFloor_m - 0.03 * diameter_m);
  return region;
}
}  // namespace

BenchPart::BenchPart(const std::string& name)
    : config(benchConfig()),
      mesh(meshOf(describe(name))),
      symmetries(describe(name).symmetries()),
      model(PpfModel::train(mesh, symmetries, config.model))
{
}

BenchPile::BenchPile(const BenchPart& part) : region(aboveFloor(part.model.diameter()))
{
  const double diameter_m = part.model.diameter();
  const Eigen::Vector3d center = part.model.data().center.cast<double>();
  const Eigen::Isometry3d T_center_off =
      poseOf(5 * M_PI / 180, {1, 2, 3}, Eigen::Vector3d(2, -1, 2) / 3 * 0.03 * diameter_m);
  std::vector<PlacedMesh> placed = {wall(kFloor_m)};
  for (const Eigen::Isometry3d& T_camera_center : places(diameter_m))
  {
    const Eigen::Translation3d T_center_model(-center);
    placed.push_back({part.mesh, T_camera_center * T_center_model});
    true_T.push_back(placed.back().T_camera_mesh.cast<float>());
    shifted_T.push_back((T_camera_center * T_center_off * T_center_model).cast<float>());
  }
  cloud = renderCloud(placed, cameraFor(diameter_m), kNoise_m);
  image = makeRangeImage(cloud, region, imageOptions(part)).image;
  scene = sampleScene(image, static_cast<float>(part.config.model.step_rel * diameter_m));
  hypotheses = highVoteHypotheses(matchModel(scene, part.model, part.config, Deadline()),
                                  part.config.min_votes_rel);
}

RangeImageOptions imageOptions(const BenchPart& part)
{
  const double diameter_m = part.model.diameter();
  RangeImageOptions options;
  options.diameter_m = options.largest_diameter_m = diameter_m;
  options.pixels_per_diameter = part.config.pixels_per_diameter;
  options.normal_radius_px = part.config.normal_radius_px;
  options.threads = part.config.threads;
  return options;
}

VoteCount countVotes(const OrientedPoints& scene, const PpfModel& model,
                     const DetectorConfig& config)
{
  const PpfModelData& data = model.data();
  const FeatureQuantizer quantizer(data.parameters, data.diameter_m);
  const NeighborSearch search(scene.points);
  const auto references = static_cast<std::size_t>(
      std::ceil(config.reference_share * static_cast<double>(scene.size())));
  VoteCount count;
  std::vector<std::uint32_t> near;
  for (std::size_t k = 0; k < references; ++k)
  {
    const std::size_t i = k * scene.size() / references;
    search.within(scene.points[i], data.diameter_m, near);
    for (const std::uint32_t j : near)
    {
      const PairFeature feature =
          pairFeature(scene.points[i], scene.normals[i], scene.points[j], scene.normals[j]);
      if (j == i || !quantizer.covers(feature.distance_m)) continue;
      const std::uint32_t key = quantizer.key(feature);
      ++count.pairs;
      count.votes += data.offsets[key + 1] - data.offsets[key];
    }
  }
  return count;
}

std::size_t countPixels(const RangeImage& image, const PpfModel& model,
                        const std::vector<Eigen::Isometry3f>& poses)
{
  std::size_t pixels = 0;
  RenderedPart rendered;
  for (const Eigen::Isometry3f& T_camera_model : poses)
  {
    renderPart(model.renderable(), T_camera_model, image.camera, rendered);
    for (const float z : rendered.depth)
      pixels += z > 0 ? 1 : 0;
  }
  return pixels;
}
}  // namespace ppf_bin_picking
