// The outer boundary of what a coverage image shows, without regard to any centre.
//
// Marching squares (Lorensen and Cline 1987 in the plane): the line on which the coverage,
// interpolated linearly between the centres of pixels, is one half.
#pragma once

#include "core/coverage.h"

namespace drape {

/// The closed line that encloses the largest area: a simple counter-clockwise polygon [m]. Nothing
/// is covered outside of the image. Throws std::invalid_argument if no pixel is covered by a half.
Points2 contour(const CoverageImage& image, const PixelGrid& grid);

}  // namespace drape
