#include "cloud_header.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>
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

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
  throw InputError(path + " is damaged or of another kind (" + why + "): write the cloud again");
}

/// The lines of a PCD header by their first word, and where the data begins.
struct PcdHeader
{
  std::map<std::string, std::string> lines;
  std::size_t data_at = 0;

  std::vector<std::uint64_t> numbers(const std::string& key) const
  {
    std::vector<std::uint64_t> values;
    const auto line = lines.find(key);
    std::istringstream stream(line == lines.end() ? "" : line->second);
    for (std::uint64_t value = 0; stream >> value;)
      values.push_back(value);
    return values;
  }
};

PcdHeader pcdHeader(const std::string& bytes)
{
  PcdHeader header;
  std::istringstream stream(bytes.substr(0, std::min(bytes.size(), kMaxHeaderBytes)));
  for (std::string line; std::getline(stream, line);)
  {
    std::istringstream words(line);
    std::string key;
    words >> key;
    std::getline(words, header.lines[key]);
    if (key != "DATA") continue;
    header.data_at = stream.eof() ? 0 : static_cast<std::size_t>(stream.tellg());
    break;
  }
  return header;
}

/// Bytes of one point.
std::uint64_t pointBytes(const PcdHeader& header)
{
  const std::vector<std::uint64_t> sizes = header.numbers("SIZE");
  std::vector<std::uint64_t> counts = header.numbers("COUNT");
  if (counts.empty()) counts.assign(sizes.size(), 1);
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < std::min(sizes.size(), counts.size()); ++k)
    sum += std::min(sizes[k], kMaxPointBytes) * std::min(counts[k], kMaxPointBytes);
  return sizes.size() == counts.size() ? sum : 0;
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

std::size_t plyElements(const std::string& bytes, const std::string& element)
{
  const std::size_t end = std::min({bytes.find("end_header"), bytes.size(), kMaxHeaderBytes});
  std::istringstream header(bytes.substr(0, end));
  for (std::string line; std::getline(header, line);)
  {
    std::istringstream words(line);
    std::string keyword;
    std::string name;
    std::size_t count = 0;
    if (words >> keyword >> name >> count && keyword == "element" && name == element) return count;
  }
  return 0;
}

std::size_t plyPoints(const std::string& bytes, const std::string& path)
{
  if (bytes.compare(0, 3, "ply") != 0 || bytes.find("end_header") == std::string::npos)
    refuse(path, "it has no PLY header");
  const std::size_t points = plyElements(bytes, "vertex");
  if (points > bytes.size()) refuse(path, "it is cut off");
  return points;
}

std::size_t pcdPoints(const std::string& bytes, const std::string& path)
{
  const PcdHeader header = pcdHeader(bytes);
  for (const char* key : {"FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT", "DATA"})
    if (header.lines.count(key) == 0) refuse(path, std::string("its header has no line ") + key);
  const std::uint64_t width = header.numbers("WIDTH").empty() ? 0 : header.numbers("WIDTH")[0];
  const std::uint64_t height = header.numbers("HEIGHT").empty() ? 0 : header.numbers("HEIGHT")[0];
  if (width > kMaxPcdPoints || height > kMaxPcdPoints || width * height > kMaxPcdPoints)
    refuse(path, "its size is out of range");
  const std::uint64_t points = width * height;
  const std::vector<std::uint64_t> stated = header.numbers("POINTS");
  if (!stated.empty() && stated[0] != points) refuse(path, "POINTS is not WIDTH times HEIGHT");
  const std::uint64_t point_bytes = pointBytes(header);
  if (point_bytes == 0 || point_bytes > kMaxPointBytes)
    refuse(path, "its SIZE and COUNT do not fit together");
  checkPcdData(header, bytes, points * point_bytes, path);
  return static_cast<std::size_t>(points);
}
}  // namespace ppf_bin_picking
