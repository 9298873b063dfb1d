/// @file Trained models as files.
#pragma once

#include "ppf_bin_picking/core/ppf_model.hpp"

#include "ppf_bin_picking/io/part_io.hpp"

#include <cstdint>
#include <string>

namespace ppf_bin_picking
{
/// Version of the file format; a file of another is refused.
constexpr std::uint32_t kModelFileVersion = 2;

/// A model as read from its file.
struct ModelFile
{
  PpfModel model;
  std::uint32_t mesh_checksum = 0;  ///< meshChecksum() of the mesh it was trained from.
  std::string path;
};

/// Writes a model: magic, version, checksum, size, then little-endian numbers. The file is there
/// whole or not at all.
/// @param mesh_checksum  meshChecksum() of the mesh as loaded: training may change the winding.
/// @throw InputError if it cannot be written.
void saveModel(const std::string& path, const PpfModel& model, std::uint32_t mesh_checksum);

/// Reads a model.
/// @throw InputError with the reason, for a file that is damaged, cut off, foreign, too long or of
///        another version.
ModelFile loadModel(const std::string& path);

/// Checks that a file's model was trained from the part as it is described now. (Its parameters are
/// modelProblem()'s matter.)
/// @param mesh_checksum  meshChecksum() of the part's mesh.
/// @throw InputError if it was trained from another mesh or unit, or with other symmetries than
///        the part file states; a model's own are taken where it states none.
void requireFit(const ModelFile& file, const PartDescription& part, std::uint32_t mesh_checksum);
}  // namespace ppf_bin_picking
