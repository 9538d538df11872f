#include "core/contour.h"

#include <array>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/outline.h"

namespace drape {
namespace {

constexpr double kLevel = 0.5;

/// A side of a cell between the centres of two neighbouring pixels: that of the upper or left one
/// (row, column), and whether the other lies below it or to its right.
using Side = std::array<int, 3>;

class Tracer {
 public:
  Tracer(const CoverageImage& image, const PixelGrid& grid) : image_(image), grid_(grid) {
    for (int row = -1; row < image.rows(); ++row)
      for (int column = -1; column < image.cols(); ++column) add_cell(row, column);
  }

  /// All closed lines, inside to their left.
  std::vector<Points2> lines() {
    std::vector<Points2> found;
    while (!next_.empty()) {
      std::vector<Vec2> points;
      for (auto at = next_.begin(); at != next_.end(); at = next_.find(to_)) {
        points.push_back(crossing(at->first));
        to_ = at->second;
        next_.erase(at);
      }
      Points2& line = found.emplace_back(static_cast<Eigen::Index>(points.size()), 2);
      for (size_t i = 0; i < points.size(); ++i) line.row(static_cast<Eigen::Index>(i)) = points[i];
    }
    return found;
  }

 private:
  double at(int row, int column) const {
    const bool within = row >= 0 && column >= 0 && row < image_.rows() && column < image_.cols();
    return within ? image_(row, column) : 0;
  }

  /// The line's parts in the cell whose upper left centre is that of pixel (row, column).
  void add_cell(int row, int column) {
    // corners and sides in the order in which they are met counter-clockwise, from the lower left
    const std::array<double, 4> value{at(row + 1, column), at(row + 1, column + 1),
                                      at(row, column + 1), at(row, column)};
    const std::array<Side, 4> side{
        Side{row + 1, column, 0}, {row, column + 1, 1}, {row, column, 0}, {row, column, 1}};
    std::vector<Side> leaves, enters;  // where the boundary of the cell leaves or enters the cloth
    for (size_t k = 0; k < 4; ++k) {
      const bool in = value[k] >= kLevel, next_in = value[(k + 1) % 4] >= kLevel;
      if (in && !next_in) leaves.push_back(side[k]);
      if (!in && next_in) enters.push_back(side[k]);
    }
    if (leaves.empty()) return;
    if (leaves.size() == 1) {
      next_[leaves[0]] = enters[0];
      return;
    }
    // two opposite corners covered: joined where the middle is
    const bool joined = value[0] + value[1] + value[2] + value[3] >= 4 * kLevel;
    const bool first_covered = value[0] >= kLevel;  // then a leave precedes each enter
    const size_t own = first_covered ? 1 : 0;       // the enter of the same covered corner
    next_[leaves[0]] = enters[joined ? 1 - own : own];
    next_[leaves[1]] = enters[joined ? own : 1 - own];
  }

  Vec2 crossing(const Side& side) const {
    const auto [row, column, down] = side;
    const double here = at(row, column), there = at(row + down, column + 1 - down);
    const double t = (kLevel - here) / (there - here);
    return grid_.origin + grid_.pixel_size * Vec2(column + 0.5 + (1 - down) * t,
                                                  grid_.rows - row - 0.5 - down * t);
  }

  const CoverageImage& image_;
  const PixelGrid& grid_;
  std::map<Side, Side> next_;
  Side to_{};
};

}  // namespace

Points2 contour(const CoverageImage& image, const PixelGrid& grid) {
  Points2 largest;
  double most = 0;
  for (Points2& line : Tracer(image, grid).lines()) {
    const double enclosed = area(line);
    if (enclosed <= most) continue;
    most = enclosed;
    largest = std::move(line);
  }
  if (largest.rows() == 0) throw std::invalid_argument("contour: the image shows no covered pixel");
  return largest;
}

}  // namespace drape
