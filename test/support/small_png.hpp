/// @file Small depth images.
#pragma once

#include <opencv2/imgcodecs.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// A PNG of one channel, 8 or 16 bit after its type.
template <class Level>
std::string pngOf(const std::vector<Level>& levels, int width)
{
  const int height = static_cast<int>(levels.size()) / width;
  const cv::Mat image(height, width, cv::DataType<Level>::type, const_cast<Level*>(levels.data()));
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}
}  // namespace ppf_bin_picking
