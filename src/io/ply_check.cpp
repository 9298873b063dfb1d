#include "ply_check.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// Thrown and caught in this file.
struct Damage : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

struct Property
{
  std::size_t count_bytes = 0;  ///< Of a list's length; 0: no list.
  std::size_t bytes = 0;        ///< Of the value, or of each item of the list.
};

struct Element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header
{
  std::string format;
  std::vector<Element> elements;
  std::size_t data_at = 0;
};

std::size_t bytesOf(const std::string& type)
{
  static const std::map<std::string, std::size_t> sizes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto size = sizes.find(type);
  if (size == sizes.end()) throw Damage("its header names the type '" + type + "'");
  return size->second;
}

Property readProperty(std::istringstream& words)
{
  std::string type;
  words >> type;
  if (type != "list") return {0, bytesOf(type)};
  std::string count_type;
  words >> count_type >> type;
  return {bytesOf(count_type), bytesOf(type)};
}

Header readHeader(const std::string& bytes)
{
  Header header;
  if (bytes.compare(0, 3, "ply") != 0) throw Damage("it does not begin with 'ply'");
  for (std::size_t at = bytes.find('\n'); at != std::string::npos;)
  {
    const std::size_t end = bytes.find('\n', at + 1);
    if (end == std::string::npos) break;
    std::istringstream words(bytes.substr(at + 1, std::min(end - at - 1, std::size_t{1000})));
    at = end;
    std::string keyword;
    words >> keyword;
    if (keyword == "end_header")
    {
      header.data_at = end + 1;
      return header;
    }
    if (keyword == "format")
      words >> header.format;
    else if (keyword == "element")
    {
      header.elements.emplace_back();
      if (!(words >> header.elements.back().name >> header.elements.back().count))
        throw Damage("an element in its header has no count");
    }
    else if (keyword == "property" && !header.elements.empty())
      header.elements.back().properties.push_back(readProperty(words));
    else if (keyword != "comment" && keyword != "obj_info")
      throw Damage("its header has the line '" + keyword.substr(0, 20) + "'");
  }
  throw Damage("its header has no end");
}

/// Passes over the values of a text file.
class TextWalk
{
public:
  TextWalk(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  /// The value of the next word, which must begin like a number.
  std::size_t take(std::size_t /*bytes*/)
  {
    while (at_ < bytes_.size() && isSpace(bytes_[at_]))
      ++at_;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !isSpace(bytes_[at_]))
      ++at_;
    if (begin == at_) throw Damage("it is cut off");
    if (std::string("+-.0123456789nNiI").find(bytes_[begin]) == std::string::npos)
      throw Damage("a word stands where a number should");
    std::size_t value = 0;
    for (std::size_t k = begin; k < std::min(at_, begin + 9) && isDigit(bytes_[k]); ++k)
      value = value * 10 + static_cast<std::size_t>(bytes_[k] - '0');
    return value;
  }

  void skip(std::size_t count, std::size_t bytes)
  {
    for (std::size_t k = 0; k < count; ++k)
      take(bytes);
  }

private:
  static bool isSpace(char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; }
  static bool isDigit(char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; }

  const std::string& bytes_;
  std::size_t at_;
};

/// Passes over the values of a binary file.
class BinaryWalk
{
public:
  BinaryWalk(const std::string& bytes, std::size_t at, bool big_endian)
      : bytes_(bytes), at_(at), big_endian_(big_endian)
  {
  }

  std::size_t take(std::size_t bytes)
  {
    const std::size_t begin = at_;
    skip(1, bytes);
    std::size_t value = 0;
    for (std::size_t k = 0; k < bytes; ++k)
    {
      const std::size_t from = big_endian_ ? k : bytes - 1 - k;
      value = value << 8U | static_cast<unsigned char>(bytes_[begin + from]);
    }
    return value;
  }

  void skip(std::size_t count, std::size_t bytes)
  {
    if (count > (bytes_.size() - at_) / bytes) throw Damage("it is cut off");
    at_ += count * bytes;
  }

private:
  const std::string& bytes_;
  std::size_t at_;
  bool big_endian_;
};

template <class Walk>
void walkElements(const Header& header, Walk walk)
{
  for (const Element& element : header.elements)
  {
    if (element.properties.empty() && element.count > 0)
      throw Damage("its element '" + element.name.substr(0, 20) + "' has no property");
    for (std::size_t item = 0; item < element.count; ++item)
      for (const Property& property : element.properties)
        walk.skip(property.count_bytes == 0 ? 1 : walk.take(property.count_bytes), property.bytes);
  }
}
}  // namespace

PlyContent checkPly(const std::string& bytes)
{
  PlyContent content;
  try
  {
    const Header header = readHeader(bytes);
    if (header.format == "ascii")
      walkElements(header, TextWalk(bytes, header.data_at));
    else if (header.format == "binary_little_endian" || header.format == "binary_big_endian")
      walkElements(header, BinaryWalk(bytes, header.data_at, header.format == "binary_big_endian"));
    else
      throw Damage("its format is neither ascii nor binary");
    for (const Element& element : header.elements)
      content.elements[element.name] = element.count;
  }
  catch (const Damage& damage)
  {
    content.damage = damage.what();
  }
  return content;
}
}  // namespace ppf_bin_picking
