#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
namespace fs = std::filesystem;

constexpr char kMagic[8] = {'P', 'P', 'F', 'H', 'U', 'L', 'L', '1'};  // 1: of this way to split
constexpr std::size_t kMostHulls = 1000;
constexpr std::size_t kMostElements = 100000;  // vertices or triangles of a hull

/// FNV-1a, 64 bits.
std::uint64_t checksum(const void* data, std::size_t size,
                       std::uint64_t sum = 14695981039346656037U)
{
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t k = 0; k < size; ++k)
    sum = (sum ^ bytes[k]) * 1099511628211U;
  return sum;
}

std::uint64_t meshChecksum(const TriangleMesh& mesh)
{
  const std::uint64_t counts[2] = {mesh.vertices.size(), mesh.triangles.size()};
  std::uint64_t sum = checksum(counts, sizeof counts);
  sum = checksum(mesh.vertices.data(), mesh.vertices.size() * sizeof mesh.vertices[0], sum);
  return checksum(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0], sum);
}

void append(std::string& bytes, const void* data, std::size_t size)
{
  bytes.append(static_cast<const char*>(data), size);
}

/// Reads from a string what append() has added; not past its end.
class Reader
{
public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  bool read(void* data, std::size_t size)
  {
    if (size > bytes_.size() - at_) return false;
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
    return true;
  }
  bool readCount(std::uint64_t& count, std::size_t most)
  {
    return read(&count, sizeof count) && count <= most;
  }
  bool atEnd() const { return at_ == bytes_.size(); }

private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// Magic, checksum of the mesh, hulls, checksum of all that; in the machine's own byte order, so
/// that a file from another kind of machine has a wrong checksum.
std::string toBytes(const ConvexHulls& hulls, std::uint64_t mesh_sum)
{
  std::string bytes(kMagic, sizeof kMagic);
  append(bytes, &mesh_sum, sizeof mesh_sum);
  const std::uint64_t count = hulls.size();
  append(bytes, &count, sizeof count);
  for (const TriangleMesh& hull : hulls)
  {
    const std::uint64_t counts[2] = {hull.vertices.size(), hull.triangles.size()};
    append(bytes, counts, sizeof counts);
    append(bytes, hull.vertices.data(), hull.vertices.size() * sizeof hull.vertices[0]);
    append(bytes, hull.triangles.data(), hull.triangles.size() * sizeof hull.triangles[0]);
  }
  const std::uint64_t sum = checksum(bytes.data(), bytes.size());
  append(bytes, &sum, sizeof sum);
  return bytes;
}

bool readHull(Reader& reader, TriangleMesh& hull)
{
  std::uint64_t vertices = 0, triangles = 0;
  if (!reader.readCount(vertices, kMostElements) || !reader.readCount(triangles, kMostElements))
    return false;
  hull.vertices.resize(vertices);
  hull.triangles.resize(triangles);
  return reader.read(hull.vertices.data(), vertices * sizeof hull.vertices[0]) &&
         reader.read(hull.triangles.data(), triangles * sizeof hull.triangles[0]);
}

/// None if the bytes are not those that toBytes() made for this mesh.
std::optional<ConvexHulls> fromBytes(std::string bytes, std::uint64_t expected_mesh_sum)
{
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof sum) return std::nullopt;
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  bytes.resize(bytes.size() - sizeof sum);
  if (sum != checksum(bytes.data(), bytes.size())) return std::nullopt;
  Reader reader(bytes);
  char magic[sizeof kMagic];
  std::uint64_t mesh_sum = 0, count = 0;
  if (!reader.read(magic, sizeof magic) || std::memcmp(magic, kMagic, sizeof magic) != 0 ||
      !reader.read(&mesh_sum, sizeof mesh_sum) || mesh_sum != expected_mesh_sum ||
      !reader.readCount(count, kMostHulls))
    return std::nullopt;
  ConvexHulls hulls(count);
  for (TriangleMesh& hull : hulls)
    if (!readHull(reader, hull)) return std::nullopt;
  if (!reader.atEnd()) return std::nullopt;
  return hulls;
}

void writeWhole(const fs::path& file, const std::string& bytes)
{
  const fs::path temporary = file.string() + "." + std::to_string(getpid()) + ".tmp";
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) fs::rename(temporary, file, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw std::invalid_argument(file.parent_path().string() +
                              " is no folder that can be written: give another one for the "
                              "convex pieces");
}
}  // namespace

ConvexHulls cachedConvexHulls(const TriangleMesh& part, const std::string& cache_folder)
{
  const std::uint64_t mesh_sum = meshChecksum(part);
  std::ostringstream name;
  name << std::hex << mesh_sum << ".hulls";
  const fs::path file = fs::path(cache_folder) / name.str();
  std::ifstream stream(file, std::ios::binary);
  if (stream)
  {
    const std::string bytes((std::istreambuf_iterator<char>(stream)),
                            std::istreambuf_iterator<char>());
    if (auto hulls = fromBytes(bytes, mesh_sum)) return *hulls;
  }
  ConvexHulls hulls = convexHulls(part);
  writeWhole(file, toBytes(hulls, mesh_sum));
  return hulls;
}
}  // namespace ppf_bin_picking
