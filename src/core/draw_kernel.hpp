/// @file Drawing of triangles, on plain arrays; private to the core. No Eigen here: draw_kernel.cpp
/// is compiled for several instruction sets, and the processor's is chosen when the program starts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ppf_bin_picking
{
/// A vertex in the image: pixel and 1/z, which is linear over the image of a plane. Behind the
/// camera: 0.
struct ImageVertex
{
  float u = 0;
  float v = 0;
  float inverse_z = 0;  ///< [1/m]
};

/// A window of the image that is drawn into, row after row.
struct DrawWindow
{
  int left;
  int top;
  int width;
  int height;
  float* inverse_z;         ///< [1/m]; 0 where nothing is drawn.
  std::uint32_t* triangle;  ///< The triangle seen; undefined where nothing is drawn.
};

/// Draws one triangle, the nearest surface wins.
void drawTriangle(const ImageVertex& a, const ImageVertex& b, const ImageVertex& c,
                  std::uint32_t index, const DrawWindow& window);

/// Turns 1/z into z and leaves 0 as it is.
void invertDepth(float* values, std::size_t count);

/// Marks the pixels of a rendered part beside which, in their row or column, nothing is drawn or
/// something deeper by a fall or more. Pixels at the window's border are marked, those where
/// nothing is drawn are not.
/// @param depth_m  Row after row [m]; 0 where nothing is drawn.
/// @param marks    One a pixel: 1 or 0.
void markFalls(const float* depth_m, int width, int height, float fall_m, std::uint8_t* marks);
}  // namespace ppf_bin_picking
