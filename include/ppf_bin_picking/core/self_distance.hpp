/// @file How far a moved part is from itself.
#pragma once

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace ppf_bin_picking
{
/// Compares a mesh with itself, moved. What is moved are samples of the outside; they are compared
/// with all triangles, so that what lies hidden in a part does not count.
class SelfDistance
{
public:
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  /// @param mesh  Metres.
  /// @throw std::invalid_argument if it has no surface.
  explicit SelfDistance(const TriangleMesh& mesh);

  /// The largest distance of a moved sample from the mesh [m], exact to the triangles near it.
  /// @param T_model_model  The motion [m].
  /// @param enough_m       The answer is any larger number once the distance exceeds this.
  /// @param samples        How many samples to move, spread over the surface.
  double deviation(const Eigen::Isometry3d& T_model_model,
                   double enough_m = std::numeric_limits<double>::infinity(),
                   std::size_t samples = kAll) const;

  /// The motion near a given one that fits best: point-to-plane steps over samples nearer than a
  /// gate [m].
  Eigen::Isometry3d refined(Eigen::Isometry3d T_model_model, double gate_m) const;

  /// Samples of the outside, every few of them spread over the surface. Mesh frame [m].
  const OrientedPoints& surface() const { return surface_; }
  const Eigen::Vector3d& center() const { return center_; }  ///< Mean of the samples [m].
  double diameter() const { return diameter_m_; }            ///< Of the mesh [m].

private:
  struct Foot
  {
    Eigen::Vector3f point;  ///< On the mesh.
    std::uint32_t triangle;
    float distance_m;
  };
  Foot footOf(const Eigen::Vector3f& point) const;

  TriangleMesh mesh_;
  double diameter_m_;
  OrientedPoints surface_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> dense_points_;
  std::vector<std::uint32_t> dense_triangles_;
  std::unique_ptr<NeighborSearch> search_;
};
}  // namespace ppf_bin_picking
