#include "ppf_bin_picking/io/model_io.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <vector>

#if !defined(__BYTE_ORDER__) || __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "model files are little-endian: add the byte swaps before building for this machine"
#endif

namespace ppf_bin_picking
{
namespace
{
constexpr char kMagic[8] = {'P', 'P', 'F', 'M', 'O', 'D', 'E', 'L'};
constexpr std::size_t kMaxModelBytes = std::size_t{1} << 32;

/// Stands at the beginning of a file.
struct Header
{
  char magic[8];
  std::uint32_t version;
  std::uint32_t checksum;  ///< CRC-32 of the payload.
  std::uint64_t size;      ///< Of the payload [bytes].
};
static_assert(sizeof(Header) == 24, "the header has gaps");

std::uint32_t checksum(const char* bytes, std::size_t size)
{
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes), size));
}

/// Appends numbers to a payload.
class Writer
{
public:
  template <class Number>
  void number(const Number& value)
  {
    raw(&value, sizeof value);
  }

  template <class Item>
  void block(const std::vector<Item>& items)
  {
    number(static_cast<std::uint64_t>(items.size()));
    raw(items.data(), items.size() * sizeof(Item));
  }

  std::string payload;

private:
  void raw(const void* data, std::size_t size)
  {
    if (size > 0) payload.append(static_cast<const char*>(data), size);
  }
};

/// Takes numbers from a payload, never past its end.
class Reader
{
public:
  Reader(const char* at, std::size_t left) : at_(at), left_(left) {}

  template <class Number>
  void number(Number& value)
  {
    raw(&value, sizeof value);
  }

  template <class Item>
  void block(std::vector<Item>& items)
  {
    std::uint64_t count = 0;
    number(count);
    if (count > left_ / sizeof(Item)) throw std::invalid_argument("a list in it is too long");
    items.resize(static_cast<std::size_t>(count));
    raw(items.data(), items.size() * sizeof(Item));
  }

  std::size_t left() const { return left_; }

private:
  void raw(void* data, std::size_t size)
  {
    if (size > left_) throw std::invalid_argument("its content ends too early");
    if (size > 0) std::memcpy(data, at_, size);
    at_ += size;
    left_ -= size;
  }

  const char* at_;
  std::size_t left_;
};

/// The order of everything in a payload, for writing and for reading.
template <class Archive, class Data, class Checksum>
void visitContent(Archive& archive, Data& data, Checksum& mesh_checksum)
{
  static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(SymmetryAxis) == 48 &&
                    sizeof(DiscreteSymmetry) == 56 && sizeof(BoundaryPoint) == 36 &&
                    sizeof(int) == 4,
                "these go into the file as they are");
  archive.number(mesh_checksum);
  archive.number(data.parameters.step_rel);
  archive.number(data.parameters.n_angle);
  archive.block(data.mesh.vertices);
  archive.block(data.mesh.triangles);
  archive.block(data.symmetries_discrete);
  archive.block(data.symmetries_continuous);
  archive.number(data.center);
  archive.number(data.diameter_m);
  archive.block(data.points);
  archive.block(data.normals);
  archive.block(data.offsets);
  archive.block(data.entries);
  archive.block(data.boundary.points);
  archive.block(data.boundary.offsets);
  archive.block(data.boundary.entries);
}

/// The reason why a file is not a model file; empty if its header and checksum are right.
std::string damageOf(const std::string& bytes)
{
  Header header{};
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    return "is no model file";
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != kModelFileVersion)
    return "has the format version " + std::to_string(header.version) + ", not " +
           std::to_string(kModelFileVersion);
  const std::size_t held = bytes.size() - sizeof header;
  if (held < header.size) return "is cut off";
  if (held > header.size) return "has bytes after its end";
  if (checksum(bytes.data() + sizeof header, held) != header.checksum)
    return "is damaged: its checksum is wrong";
  return {};
}

bool same(const SymmetryAxis& a, const SymmetryAxis& b)
{
  return a.axis == b.axis && a.point == b.point;
}

bool sameSymmetries(const PpfModelData& data, const PartDescription& part)
{
  const auto& continuous = data.symmetries_continuous;
  const auto& discrete = data.symmetries_discrete;
  return std::equal(continuous.begin(), continuous.end(), part.symmetries_continuous.begin(),
                    part.symmetries_continuous.end(), same) &&
         std::equal(discrete.begin(), discrete.end(), part.symmetries_discrete.begin(),
                    part.symmetries_discrete.end(),
                    [](const DiscreteSymmetry& a, const DiscreteSymmetry& b)
                    { return same(a.line, b.line) && a.angle_rad == b.angle_rad; });
}
}  // namespace

void saveModel(const std::string& path, const PpfModel& model, std::uint32_t mesh_checksum)
{
  Writer writer;
  visitContent(writer, model.data(), mesh_checksum);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = kModelFileVersion;
  header.checksum = checksum(writer.payload.data(), writer.payload.size());
  header.size = writer.payload.size();
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  writeFile(path, bytes + writer.payload);
}

ModelFile loadModel(const std::string& path)
{
  const std::string bytes = readFile(path, kMaxModelBytes);
  const std::string damage = damageOf(bytes);
  if (!damage.empty()) throw InputError(path + " " + damage + ": train the model again");
  try
  {
    Reader reader(bytes.data() + sizeof(Header), bytes.size() - sizeof(Header));
    PpfModelData data;
    std::uint32_t mesh_checksum = 0;
    visitContent(reader, data, mesh_checksum);
    if (reader.left() != 0) throw std::invalid_argument("its content ends too late");
    return {PpfModel(std::move(data)), mesh_checksum, path};
  }
  catch (const std::invalid_argument& error)
  {
    throw InputError(path + " is damaged (" + error.what() + "): train the model again");
  }
}

void requireFit(const ModelFile& file, const PartDescription& part, std::uint32_t mesh_checksum)
{
  if (file.mesh_checksum != mesh_checksum)
    throw InputError(file.path + " was trained from another mesh than " + part.mesh_file +
                     ", or in another unit: train the model again");
  if (part.states_symmetries && !sameSymmetries(file.model.data(), part))
    throw InputError(file.path + " was trained with other symmetries than " + part.source +
                     " states: train the model again");
}
}  // namespace ppf_bin_picking
