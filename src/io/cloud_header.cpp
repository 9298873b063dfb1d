#include "cloud_header.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include "ply_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxHeaderBytes = 1 << 16;
constexpr std::uint64_t kMaxPointBytes = 1 << 12;
constexpr std::uint64_t kMaxPcdPoints = std::numeric_limits<std::uint32_t>::max();

/// All lines that a header may have; the library crashes after others.
const std::array<std::string, 10> kKeys = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                           "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
  throw InputError(path + " is damaged or of another kind (" + why + "): write the cloud again");
}

/// The lines of a PCD header by their first word, and where the data begins.
struct PcdHeader
{
  std::map<std::string, std::string> lines;
  std::size_t data_at = 0;

  template <class Value>
  std::vector<Value> values(const std::string& key) const
  {
    std::vector<Value> values;
    const auto line = lines.find(key);
    std::istringstream stream(line == lines.end() ? "" : line->second);
    for (Value value; stream >> value;)
      values.push_back(value);
    return values;
  }
  /// The first number of a line; 0 if there is none.
  std::uint64_t number(const std::string& key) const
  {
    const std::vector<std::uint64_t> all = values<std::uint64_t>(key);
    return all.empty() ? 0 : all.front();
  }
};

/// Its lines, each once: the library allocates and forgets as it meets them.
PcdHeader readHeader(const std::string& bytes, const std::string& path)
{
  PcdHeader header;
  std::istringstream stream(bytes.substr(0, std::min(bytes.size(), kMaxHeaderBytes)));
  for (std::string line; std::getline(stream, line);)
  {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key.empty() || key[0] == '#') continue;
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
      refuse(path, "its header has a line that PCD does not know");
    if (header.lines.count(key) != 0) refuse(path, "its header has two lines " + key);
    std::getline(words, header.lines[key]);
    if (key != "DATA") continue;
    header.data_at = stream.eof() ? bytes.size() : static_cast<std::size_t>(stream.tellg());
    break;
  }
  for (const std::string& key : kKeys)
    if (header.lines.count(key) == 0 && key != "VERSION" && key != "VIEWPOINT")
      refuse(path, "its header has no line " + key);
  return header;
}

/// Bytes of one point; 0 if the lines that describe its fields do not fit together.
std::uint64_t pointBytes(const PcdHeader& header)
{
  const auto sizes = header.values<std::uint64_t>("SIZE");
  const auto counts = header.values<std::uint64_t>("COUNT");
  const auto types = header.values<std::string>("TYPE");
  const std::size_t fields = header.values<std::string>("FIELDS").size();
  if (sizes.size() != fields || counts.size() != fields || types.size() != fields) return 0;
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < fields; ++k)
  {
    const bool is_number = types[k] == "F" || types[k] == "I" || types[k] == "U";
    const bool has_size = sizes[k] == 1 || sizes[k] == 2 || sizes[k] == 4 || sizes[k] == 8;
    if (!is_number || !has_size || counts[k] == 0 || counts[k] > kMaxPointBytes) return 0;
    sum += sizes[k] * counts[k];
  }
  return sum;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at)
{
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Compares the data's size with the one announced.
void checkPcdData(const PcdHeader& header, const std::string& bytes, std::uint64_t announced,
                  const std::string& path)
{
  const std::string kind = header.lines.at("DATA");
  const std::uint64_t held = bytes.size() - header.data_at;
  if (kind.find("binary_compressed") != std::string::npos)
  {
    if (held < 8 || held - 8 < wordAt(bytes, header.data_at)) refuse(path, "it is cut off");
    if (wordAt(bytes, header.data_at + 4) != announced)
      refuse(path, "its data has another size than its header says");
  }
  else if (kind.find("binary") != std::string::npos && held < announced)
    refuse(path, "it is cut off");
}
}  // namespace

std::size_t plyPoints(const std::string& bytes, const std::string& path)
{
  PlyContent content = checkPly(bytes);
  if (!content.damage.empty()) refuse(path, content.damage);
  return content.elements["vertex"];
}

std::size_t pcdPoints(const std::string& bytes, const std::string& path)
{
  const PcdHeader header = readHeader(bytes, path);
  const std::uint64_t width = header.number("WIDTH");
  const std::uint64_t height = header.number("HEIGHT");
  if (width > kMaxPcdPoints || height > kMaxPcdPoints || width * height > kMaxPcdPoints)
    refuse(path, "its size is out of range");
  const std::uint64_t points = width * height;
  if (header.number("POINTS") != points) refuse(path, "POINTS is not WIDTH times HEIGHT");
  const std::uint64_t point_bytes = pointBytes(header);
  if (point_bytes == 0 || point_bytes > kMaxPointBytes)
    refuse(path, "its FIELDS, SIZE, TYPE and COUNT do not fit together");
  if (header.lines.count("VIEWPOINT") != 0 && header.values<double>("VIEWPOINT").size() != 7)
    refuse(path, "its VIEWPOINT has not seven numbers");
  checkPcdData(header, bytes, points * point_bytes, path);
  return static_cast<std::size_t>(points);
}
}  // namespace ppf_bin_picking
