/// @file A bin and a camera that suit a part.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/simulated_cell.hpp"

namespace ppf_bin_picking
{
/// The area that a part hides of a plane behind it, mean over all directions [m^2].
double meanShadow(const TriangleMesh& part);

/// The smallest bin of two rules, in which many parts lie in two to three layers and few lie apart.
///
/// - Floor: the parts' mean shadows add up to at most 1.6 times its area (a layer hides about two
///   thirds of what is under it), and its shorter side is at least 2.1 times the part's diameter,
///   the largest distance between two vertices. The sides are as 4 to 3.
/// - Height: three times the part's smallest width, plus half its diameter.
/// @param count  How many parts. >= 1.
/// @throw std::invalid_argument if the mesh hides nothing from any side.
Bin binFor(const TriangleMesh& part, int count);

/// A cell with that bin and a sensor. The middle between camera and projector stands over the bin,
/// 10 degrees from the vertical along the bin's y axis; the camera looks at the middle of the bin's
/// opening, from as near as the whole bin is within the middle nine tenths of the image, but no
/// nearer than 0.5 m above it.
/// @throw std::invalid_argument as binFor(), or if the bin is too large for any distance.
CellSettings cellFor(const TriangleMesh& part, int count, const DepthSensor& sensor);
}  // namespace ppf_bin_picking
