// From the photograph of a draped specimen, seen from above as a mask, to its outline in metres.
//
// The mask is bright on dark or dark on bright; the background is whatever fills most of the
// image's border. Grey values are read as the share of a pixel that the shadow covers (0 at the
// background's median grey, 1 at the silhouette's), and the outline is where this share,
// interpolated bilinearly, crosses one half along rays from the centroid: unlike the corners of a
// pixel contour this is not biased by half a pixel.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "core/coverage.h"
#include "core/scene.h"
#include "core/types.h"

namespace drape {

/// Thrown for an image that is no silhouette of a drape; what() names the file, what is wrong and
/// what would be right.
struct PhotographError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Directions of the dense outline, four a degree.
inline constexpr int kOutlineSize = 1440;

/// A silhouette in the frame of its area centroid: +x right, +y up in the image, metres.
struct Photograph {
  Points2 outline;       ///< outermost crossing a direction, counter-clockwise (kOutlineSize) [m]
  Points2 boundary;      ///< all of it, the pockets behind a lobe included, counter-clockwise [m]
  VecX profile;          ///< outermost radius at whole degrees (kProfileSize) [m]
  Vec2 centroid_pixels;  ///< area centroid (column, row); a pixel's centre has whole numbers
  double metres_per_pixel;  ///< as given
  int width, height;        ///< of the image [pixels]
  PixelGrid grid;           ///< the image's own pixels, in the frame of the centroid
  CoverageImage coverage;   ///< share of each pixel inside the silhouette (height x width)
  double area;              ///< sum of the coverage, pockets behind a lobe excluded [m^2]
  double reentrant_share;   ///< share of directions that cross the outline more than once
  bool star_shaped;         ///< no such direction: `outline` then is the whole boundary
};

/// Reads a mask (PNG or JPEG; an orientation stored in the file is applied). Blobs and holes below
/// a thousandth of the silhouette's area are specks and ignored. Throws PhotographError on: a scale
/// that is not positive; a file that is missing, empty, cut short or no image; more than 1e8
/// pixels; a uniform image; a silhouette that touches the border, has holes, comes in several blobs
/// or in fewer than 1000 pixels; a blurred edge; an area that is not between the support's and the
/// specimen's, 3 % of scale allowed for; a centroid outside of the silhouette.
Photograph read_photograph(const std::filesystem::path& file, double metres_per_pixel,
                           const Scene& scene);

}  // namespace drape
