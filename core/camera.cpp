#include "core/camera.h"

#include <stdexcept>
#include <string>

namespace drape {

VecX Camera::seen(const VecX& x) const {
  VecX result = x;
  if (orthographic()) return result;
  for (Eigen::Index i = 0; i < x.size(); i += 3) {
    if (!(x[i + 2] < height))
      throw std::runtime_error("a vertex at z = " + std::to_string(x[i + 2]) +
                               " m is as high as the camera, " + std::to_string(height) + " m");
    result.segment<2>(i) *= height / (height - x[i + 2]);
  }
  return result;
}

VecX Camera::pull_back(const VecX& x, const VecX& dL_dseen) const {
  VecX result = dL_dseen;
  if (orthographic()) return result;
  for (Eigen::Index i = 0; i < x.size(); i += 3) {
    const double scale = height / (height - x[i + 2]);
    const Vec2 dL_dP = dL_dseen.segment<2>(i);
    result.segment<2>(i) = scale * dL_dP;
    result[i + 2] += scale / (height - x[i + 2]) * dL_dP.dot(x.segment<2>(i));
  }
  return result;
}

VecX Camera::push_forward(const VecX& x, const VecX& dx) const {
  VecX result = dx;
  if (orthographic()) return result;
  for (Eigen::Index i = 0; i < x.size(); i += 3) {
    const double scale = height / (height - x[i + 2]);
    result.segment<2>(i) =
        scale * (dx.segment<2>(i) + dx[i + 2] / (height - x[i + 2]) * x.segment<2>(i));
  }
  return result;
}

}  // namespace drape
