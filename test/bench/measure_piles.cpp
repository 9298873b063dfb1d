/// @file measure_piles: how well the simulated piles of parts behave, a table row for each part
/// file. The columns are explained in docs/simulator.md.
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/sim/part_pile.hpp"

#include "support/overlap.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMoved_m = 0.0005;   // a part that moves further afterwards has not been at rest
constexpr double kAfterwards_s = 2;   // simulated
constexpr float kSpacing_m = 0.001F;  // of the surface points whose depth is measured

struct Options
{
  std::vector<std::string> part_files;
  std::string cache_folder;
  int first_seed = 1;
  int seeds = 20;
  int count = 40;
};

struct Figures
{
  int parts = 0;
  int outside = 0;
  int moving = 0;
  int moving_awake = 0;
  int failures = 0;
  double simulation_s = 0;  ///< Of one thread.
  std::vector<double> overlaps_m;
  std::vector<double> creep_m;  ///< Of each part, with all awake.
};

double percentileMm(const std::vector<double>& sorted_m, double share)
{
  if (sorted_m.empty()) return 0;
  return 1e3 * sorted_m[static_cast<std::size_t>(share * static_cast<double>(sorted_m.size() - 1))];
}

/// Whether a part's middle is not over the floor, or a corner of it lies below the floor or, where
/// that is lower than the rim, beyond a wall.
bool isOutside(const Bin& bin, const TriangleMesh& part, const Eigen::Isometry3d& T_bin_part)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const Eigen::Array2d half = bin.size_m.head<2>().array() / 2;
  for (const Eigen::Vector3f& vertex : part.vertices)
  {
    const Eigen::Vector3d corner = T_bin_part * vertex.cast<double>();
    middle += corner / static_cast<double>(part.vertices.size());
    if (corner.z() < -bin.wall_m) return true;
    if (corner.z() < bin.size_m.z() - bin.wall_m &&
        (corner.head<2>().array().abs() > half + bin.wall_m).any())
      return true;
  }
  return (middle.head<2>().array().abs() > half).any();
}

void measurePile(const Bin& bin, const TriangleMesh& part, const ConvexHulls& hulls, int count,
                 std::uint32_t seed, Figures& figures)
{
  const std::clock_t start = std::clock();
  PartPile pile(bin, part, hulls);
  pile.drop(count, seed);
  figures.simulation_s += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const auto poses = pile.poses();
  pile.simulate(kAfterwards_s);
  const auto again = pile.poses();
  pile.wake();
  pile.simulate(kAfterwards_s);
  const auto awake = pile.poses();
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    ++figures.parts;
    if (isOutside(bin, part, poses[k])) ++figures.outside;
    if (furthestMove(part, poses[k], again[k]) > kMoved_m) ++figures.moving;
    figures.creep_m.push_back(furthestMove(part, again[k], awake[k]));
    if (figures.creep_m.back() > kMoved_m) ++figures.moving_awake;
  }
  const auto overlaps = deepestOverlaps(bin, part, poses, kSpacing_m);
  figures.overlaps_m.insert(figures.overlaps_m.end(), overlaps.begin(), overlaps.end());
}

void measurePart(const std::string& part_file, const Options& options)
{
  const PartDescription description = loadPart(part_file);
  const TriangleMesh part = loadMesh(description.mesh_file, description.unit).mesh;
  const ConvexHulls hulls = options.cache_folder.empty()
                                ? convexHulls(part)
                                : cachedConvexHulls(part, options.cache_folder);
  Figures figures;
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
  {
    try
    {
      measurePile({}, part, hulls, options.count, static_cast<std::uint32_t>(seed), figures);
    }
    catch (const std::exception& error)
    {
      ++figures.failures;
      std::cerr << description.model_id << ", seed " << seed << ": " << error.what() << "\n";
    }
  }
  std::sort(figures.overlaps_m.begin(), figures.overlaps_m.end());
  std::sort(figures.creep_m.begin(), figures.creep_m.end());
  const int piles = std::max(1, options.seeds - figures.failures);
  std::printf("| %s | %zu | %d | %d | %d | %d | %d | %d | %.2f | %.2f | %.2f | %.2f | %.1f |\n",
              description.model_id.c_str(), hulls.size(), options.seeds, figures.parts,
              figures.failures, figures.outside, figures.moving, figures.moving_awake,
              percentileMm(figures.creep_m, 0.99), percentileMm(figures.overlaps_m, 0.5),
              percentileMm(figures.overlaps_m, 0.99), percentileMm(figures.overlaps_m, 1),
              figures.simulation_s / piles * 40 / std::max(1, options.count));
  std::fflush(stdout);
}

void run(const Options& options)
{
  std::puts(
      "| part | hulls | seeds | parts | failed piles | outside | moving | awake | creep p99 mm | "
      "overlap "
      "p50 mm | p99 mm | max mm | CPU s per 40 parts |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const std::string& part_file : options.part_files)
    measurePart(part_file, options);
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  ppf_bin_picking::Options options;
  CLI::App app("Drops parts into a bin and measures what comes of it.");
  app.add_option("parts", options.part_files, "part files")->required();
  app.add_option("--seeds", options.seeds, "piles of each part")->check(CLI::Range(1, 1000));
  app.add_option("--first-seed", options.first_seed, "of these piles")
      ->check(CLI::Range(0, 1000000));
  app.add_option("--count", options.count, "parts of a pile")->check(CLI::Range(1, 500));
  app.add_option("--cache", options.cache_folder, "folder of the convex hulls");
  CLI11_PARSE(app, argc, argv);
  try
  {
    run(options);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
