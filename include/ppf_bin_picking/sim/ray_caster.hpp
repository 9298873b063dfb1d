/// @file What a ray meets first among placed meshes.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// A mesh at its place in the world.
struct PlacedMesh
{
  const TriangleMesh* mesh = nullptr;  ///< Not null; read by the constructor only.
  Eigen::Isometry3d T_world_mesh = Eigen::Isometry3d::Identity();  ///< [m]
};

/// Where a ray met a surface.
struct RayHit
{
  float distance_m = 0;                              ///< Along the ray.
  std::uint32_t object = 0;                          ///< Index of the mesh.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< Unit length, of the triangle as wound.
};

/// A scene for ray casting. Immutable; any number of threads may cast at once.
class RayCaster
{
public:
  /// @throw std::invalid_argument if a mesh names a vertex that it does not have.
  explicit RayCaster(const std::vector<PlacedMesh>& meshes);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// @param origin     World frame [m].
  /// @param direction  World frame, unit length.
  std::optional<RayHit> cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  /// Whether a surface lies between two points. Ends that lie on a surface may count as such.
  /// @param from, to  World frame [m].
  bool blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};
}  // namespace ppf_bin_picking
