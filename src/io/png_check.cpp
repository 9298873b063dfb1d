#include "png_check.hpp"

#include <zlib.h>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kChunkBytes = 12;  // length, type and checksum
constexpr std::size_t kHeaderDataBytes = 13;

std::uint32_t bigEndian(const std::string& bytes, std::size_t at)
{
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

void readHeader(const std::string& bytes, PngHeader& header)
{
  const std::size_t data = kSignatureBytes + 8;
  header.width = bigEndian(bytes, data);
  header.height = bigEndian(bytes, data + 4);
  header.bit_depth = static_cast<unsigned char>(bytes[data + 8]);
  header.color_type = static_cast<unsigned char>(bytes[data + 9]);
}
}  // namespace

PngHeader checkPng(const std::string& bytes)
{
  PngHeader header;
  const auto damaged = [&](const char* why)
  {
    header.damage = why;
    return header;
  };
  if (bytes.compare(0, kSignatureBytes, "\x89PNG\r\n\x1a\n") != 0) return damaged("it is no PNG");
  for (std::size_t at = kSignatureBytes; at + kChunkBytes <= bytes.size();)
  {
    const std::size_t length = bigEndian(bytes, at);
    const std::string type = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - kChunkBytes) break;
    const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()) + at + 4, length + 4);
    if (sum != bigEndian(bytes, at + 8 + length)) return damaged("a checksum in it is wrong");
    if (at == kSignatureBytes)
    {
      if (type != "IHDR" || length != kHeaderDataBytes) return damaged("its header is missing");
      readHeader(bytes, header);
    }
    if (type == "IEND") return header;
    at += kChunkBytes + length;
  }
  return damaged("it is cut off");
}
}  // namespace ppf_bin_picking
