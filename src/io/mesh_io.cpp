#include "ppf_bin_picking/io/mesh_io.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include "ply_check.hpp"
#include "stl_tidy.hpp"
#include "surface.hpp"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;
constexpr double kMaxExtent_m = 1000;

/// The file's content on its way to an importer, with what is known about its faults.
struct MeshFile
{
  std::string bytes;
  std::string format;      ///< `stl`, `obj` or `ply`.
  std::size_t facets = 0;  ///< Announced; 0: unknown.
  std::vector<std::string> oddities;
  std::string loss;
};

std::string lowerCase(std::string text)
{
  for (char& letter : text)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string unreadable(const std::string& path, const std::string& why)
{
  return path + " cannot be read (" + why + "): export the part again";
}

MeshFile readMeshFile(const std::string& path)
{
  MeshFile file;
  file.format = lowerCase(std::filesystem::path(path).extension().string());
  if (!file.format.empty()) file.format.erase(0, 1);
  if (file.format != "stl" && file.format != "obj" && file.format != "ply")
    throw InputError(path + " is no mesh file by its name: give an .stl, .obj or .ply file");
  file.bytes = readFile(path, kMaxMeshBytes);
  if (file.format == "obj") return file;
  if (file.format == "ply")
  {
    PlyContent content = checkPly(file.bytes);
    if (!content.damage.empty()) throw InputError(unreadable(path, content.damage));
    file.facets = content.elements["face"];
    return file;
  }
  TidyStl tidy = tidyStl(file.bytes);
  return {std::move(tidy.bytes), "stl", tidy.facets, std::move(tidy.oddities), tidy.loss};
}

/// Appends the triangles of one mesh of the scene, and the normals the file states for them.
void append(const aiMesh& mesh, RawSurface& surface)
{
  const std::size_t first = surface.vertices.size();
  for (unsigned int i = 0; i < mesh.mNumVertices; ++i)
  {
    const aiVector3D& v = mesh.mVertices[i];
    surface.vertices.emplace_back(v.x, v.y, v.z);
    const aiVector3D n = mesh.HasNormals() ? mesh.mNormals[i] : aiVector3D();
    surface.normals.emplace_back(n.x, n.y, n.z);
  }
  for (unsigned int i = 0; i < mesh.mNumFaces; ++i)
  {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    surface.triangles.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

std::string noSurface(const std::string& path, const std::string& why)
{
  return path + " holds no finite surface (" + why + "): export the part again as a mesh";
}

/// The number of faces. @throw InputError if one names a vertex that does not exist.
std::size_t checkedFaces(const aiScene& scene, const std::string& path)
{
  std::size_t faces = 0;
  for (unsigned int m = 0; m < scene.mNumMeshes; ++m)
  {
    const aiMesh& mesh = *scene.mMeshes[m];
    faces += mesh.mNumFaces;
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned int k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
        if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices)
          throw InputError(unreadable(path, "a face names a vertex that does not exist"));
  }
  return faces;
}

RawSurface imported(const MeshFile& file, const std::string& path)
{
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(), 0, file.format.c_str());
  if (scene == nullptr)
  {
    std::string why = importer.GetErrorString();
    why = why.substr(0, std::min(why.find('\n'), std::size_t{120}));
    throw InputError(unreadable(path, why));
  }
  const std::size_t faces = checkedFaces(*scene, path);
  if (file.facets != 0 && faces != file.facets)
    throw InputError(unreadable(path, "of its " + std::to_string(file.facets) + " facets only " +
                                          std::to_string(faces) + " are usable"));
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  RawSurface surface;
  for (unsigned int i = 0; scene != nullptr && i < scene->mNumMeshes; ++i)
    append(*scene->mMeshes[i], surface);
  return surface;
}
}  // namespace

LoadedMesh loadMesh(const std::string& path, LengthUnit unit)
{
  const MeshFile file = readMeshFile(path);
  if (file.format == "stl" && file.facets == 0)
    throw InputError(noSurface(path, file.loss.empty() ? "no facet" : file.loss));
  CleanSurface clean = cleaned(imported(file, path), metres(unit));
  if (clean.mesh.triangles.empty()) throw InputError(noSurface(path, "no triangle with an area"));
  if (!(clean.extent_m < kMaxExtent_m))
    throw InputError(path + " is " + std::to_string(clean.extent_m) +
                     " m large: check its unit, and that no vertex lies far off");
  if (!file.loss.empty() && clean.open_edges > 0)
    throw InputError(path + " seems to have lost a part of its surface (" + file.loss +
                     ", and the surface is not closed): export the part again");

  LoadedMesh loaded;
  const auto warn = [&](const std::string& text) { loaded.warnings.push_back(path + " " + text); };
  if (!file.loss.empty()) warn("is closed and therefore used, although " + file.loss);
  for (const std::string& oddity : file.oddities)
    warn(oddity);
  const bool normals_matter = file.format == "stl";
  for (const std::string& oddity : clean.oddities(normals_matter))
    warn(oddity);
  loaded.mesh = std::move(clean.mesh);
  return loaded;
}

std::vector<Eigen::Vector3d> loadVertices(const std::string& path, LengthUnit unit)
{
  std::set<std::array<double, 3>> distinct;
  for (const Eigen::Vector3f& vertex : imported(readMeshFile(path), path).vertices)
  {
    const Eigen::Vector3d v = vertex.cast<double>() + Eigen::Vector3d::Zero();  // -0 becomes 0
    if (v.allFinite()) distinct.insert({v.x(), v.y(), v.z()});
  }
  if (distinct.empty()) throw InputError(noSurface(path, "no vertex"));
  std::vector<Eigen::Vector3d> vertices;
  for (const std::array<double, 3>& v : distinct)
    vertices.push_back(metres(unit) * Eigen::Vector3d(v.data()));
  return vertices;
}

std::uint32_t meshChecksum(const TriangleMesh& mesh)
{
  const auto add = [](uLong crc, const void* data, std::size_t bytes)
  { return crc32_z(crc, static_cast<const Bytef*>(data), bytes); };
  const std::uint64_t counts[2] = {mesh.vertices.size(), mesh.triangles.size()};
  uLong crc = add(crc32_z(0, nullptr, 0), counts, sizeof counts);
  crc = add(crc, mesh.vertices.data(), mesh.vertices.size() * sizeof mesh.vertices[0]);
  crc = add(crc, mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
  return static_cast<std::uint32_t>(crc);
}
}  // namespace ppf_bin_picking
