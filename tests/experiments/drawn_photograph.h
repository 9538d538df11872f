// Silhouettes that are drawn instead of taken.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

namespace drape {

/// A drape of 128 x 128 pixels of 2.78 mm, 112 mm in the mean with folds of 9 mm, dark on light.
inline std::string silhouette(int folds) {
  std::string image = "P5 128 128 255\n";
  for (int row = 0; row < 128; ++row)
    for (int column = 0; column < 128; ++column) {
      const double x = column - 63.5, y = row - 63.5;
      const double radius = (112 + 9 * std::cos(folds * std::atan2(y, x))) / 2.78;
      const double inside = std::clamp(radius - std::hypot(x, y) + 0.5, 0., 1.);
      image += static_cast<char>(static_cast<unsigned char>(std::lround(230 - 200 * inside)));
    }
  return image;
}

}  // namespace drape
