#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "ppf_bin_picking/sim/part_pile.hpp"

namespace ppf_bin_picking
{
CellShot simulateCell(const CellSettings& settings, const TriangleMesh& part, int count,
                      std::uint32_t seed)
{
  const Eigen::Isometry3d T_base_bin(Eigen::Translation3d(settings.bin_position_m));
  const TriangleMesh bin = binMesh(settings.bin);
  std::vector<PlacedMesh> meshes = {{&bin, T_base_bin}};
  std::vector<Eigen::Isometry3d> T_base_parts;
  PartPile pile(settings.bin, part,
                settings.cache_folder.empty() ? convexHulls(part)
                                              : cachedConvexHulls(part, settings.cache_folder));
  pile.drop(count, seed);
  for (const Eigen::Isometry3d& T_bin_part : pile.poses())
  {
    T_base_parts.push_back(T_base_bin * T_bin_part);
    meshes.push_back({&part, T_base_parts.back()});
  }
  const RayCaster world(meshes);
  CellShot shot;
  shot.T_base_camera = lookAt(settings.camera_position_m, settings.camera_target_m);
  shot.view = takeShot(world, settings.sensor, shot.T_base_camera, seed);
  shot.parts =
      partTruths(shot.view, settings.sensor.camera, shot.T_base_camera, part, T_base_parts, 1);
  return shot;
}
}  // namespace ppf_bin_picking
