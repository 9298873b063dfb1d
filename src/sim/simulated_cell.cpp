#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include <string>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr std::uint32_t kShots = 0x5107;  // any number that tells the two uses of a seed apart
}

SimulatedCell::SimulatedCell(const CellSettings& settings, CellPart part, std::uint32_t seed)
    : settings_(settings),
      part_(std::move(part)),
      bin_mesh_(binMesh(settings.bin)),
      pile_(settings.bin, part_.mesh, part_.hulls),
      judge_(part_.mesh, part_.symmetries, settings.pick),
      T_base_bin_(Eigen::Translation3d(settings.bin_position_m)),
      T_base_camera_(lookAt(settings.camera_position_m, settings.camera_target_m)),
      drop_seeds_(seed),
      shot_seeds_(seed ^ kShots)
{
}

void SimulatedCell::refill(int count)
{
  pile_.drop(count, static_cast<std::uint32_t>(drop_seeds_()));
}

PickVerdict SimulatedCell::pick(const Eigen::Isometry3d& T_base_model)
{
  const PickVerdict verdict = judge_.judge(T_base_bin_.inverse() * T_base_model, pile_.poses());
  if (verdict.outcome == PickOutcome::kTaken)
  {
    pile_.remove(verdict.part);
    pile_.settle();
  }
  return verdict;
}

CellShot SimulatedCell::shot()
{
  const std::vector<Eigen::Isometry3d> T_base_parts = parts();
  std::vector<PlacedMesh> meshes = {{&bin_mesh_, T_base_bin_}};
  for (const Eigen::Isometry3d& T_base_part : T_base_parts)
    meshes.push_back({&part_.mesh, T_base_part});
  CellShot shot;
  shot.view = takeShot(RayCaster(meshes), settings_.sensor, T_base_camera_,
                       static_cast<std::uint32_t>(shot_seeds_()));
  shot.parts =
      partTruths(shot.view, settings_.sensor.camera, T_base_camera_, part_.mesh, T_base_parts, 1);
  return shot;
}

std::vector<Eigen::Isometry3d> SimulatedCell::parts() const
{
  std::vector<Eigen::Isometry3d> poses = pile_.poses();
  for (Eigen::Isometry3d& pose : poses)
    pose = T_base_bin_ * pose;
  return poses;
}
}  // namespace ppf_bin_picking
