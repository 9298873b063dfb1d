/// @file The trained, immutable model of a part: surface samples, pair-feature table, mesh,
/// symmetries.
#pragma once

#include "ppf_bin_picking/core/boundary_table.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <memory>
#include <vector>

namespace ppf_bin_picking
{
/// The content of a model, as written to a file. Points are metres in the mesh's frame shifted by
/// -center.
struct PpfModelData
{
  ModelParameters parameters;
  TriangleMesh mesh;  ///< Mesh frame, wound so that normals point out of the part.
  std::vector<DiscreteSymmetry> symmetries_discrete;  ///< Mesh frame.
  std::vector<SymmetryAxis> symmetries_continuous;    ///< Mesh frame.
  Eigen::Vector3f center = Eigen::Vector3f::Zero();   ///< Of the bounding sphere, mesh frame [m].
  float diameter_m = 0;                               ///< Largest distance between two vertices.
  std::vector<Eigen::Vector3f> points;                ///< Sampled surface, relative to center [m].
  std::vector<Eigen::Vector3f> normals;               ///< Outward, unit length.
  std::vector<std::uint32_t> offsets;  ///< Entries of key k: [offsets[k], offsets[k + 1]).
  std::vector<std::uint32_t> entries;  ///< (reference index << 16) | alpha; a full turn is 65536.
  BoundaryTable boundary;
};

/// A part as the detector knows it. Immutable; share it between threads.
class PpfModel
{
public:
  /// Samples the mesh and builds the table.
  /// @param mesh  Metres. Surfaces that no viewpoint outside the part sees are left out.
  /// @throw std::invalid_argument if the mesh has no surface, or its parameters are out of range.
  static PpfModel train(const TriangleMesh& mesh, const SymmetryGroup& symmetries,
                        const ModelParameters& parameters);

  /// Takes over what a file holds.
  /// @throw std::invalid_argument naming the contradiction, if sizes or indices do not fit
  /// together.
  explicit PpfModel(PpfModelData data);

  const PpfModelData& data() const { return data_; }
  const ModelParameters& parameters() const { return data_.parameters; }
  const SymmetryGroup& symmetries() const { return symmetries_; }
  const RenderableMesh& renderable() const { return renderable_; }
  /// See lookAlikeTurns().
  const std::vector<Eigen::Isometry3f>& lookAlikes() const { return look_alikes_; }
  double diameter() const { return data_.diameter_m; }  ///< [m]

  /// The table's reference points are the first so many points: of points that the symmetries lay
  /// onto each other one is enough.
  std::size_t references() const { return references_; }

private:
  PpfModelData data_;
  SymmetryGroup symmetries_;
  RenderableMesh renderable_;
  std::vector<Eigen::Isometry3f> look_alikes_;
  std::size_t references_ = 0;
};
}  // namespace ppf_bin_picking
