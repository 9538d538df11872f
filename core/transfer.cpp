#include "core/transfer.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace drape {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNeighbours = 24;       // inside of the mesh, on average; half of them at the rim
constexpr size_t kFewestNeighbours = 9;  // a quadratic has six coefficients
constexpr double kWorstCondition = 1e-8;
constexpr double kFarthest = 0.5;  // nearest vertex over support radius: more is extrapolation
constexpr double kGrowth = 1.25;   // of a support radius that holds too few vertices
constexpr double kMostGrowth = 2;  // in all

/// Points sorted into square cells, to list those within a radius.
class Grid {
 public:
  Grid(const Points2& points, double cell) : points_(points), cell_(cell) {
    low_ = points.colwise().minCoeff();
    const Vec2 extent = Vec2(points.colwise().maxCoeff()) - low_;
    columns_ = static_cast<int>(extent.x() / cell) + 1;
    rows_ = static_cast<int>(extent.y() / cell) + 1;
    start_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
    const auto cell_of = [&](Eigen::Index i) {
      const Vec2 p = (Vec2(points.row(i)) - low_) / cell_;
      return static_cast<size_t>(p.y()) * static_cast<size_t>(columns_) +
             static_cast<size_t>(p.x());
    };
    for (Eigen::Index i = 0; i < points.rows(); ++i) ++start_[cell_of(i) + 1];
    for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<int> next(start_.begin(), start_.end() - 1);
    sorted_.resize(static_cast<size_t>(points.rows()));
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      sorted_[static_cast<size_t>(next[cell_of(i)]++)] = static_cast<int>(i);
  }

  /// Points closer to `centre` than `radius`, in ascending order.
  void list(const Vec2& centre, double radius, std::vector<int>& found) const {
    found.clear();
    const auto range = [&](double middle, int count) {
      const double first = std::floor((middle - radius) / cell_);
      const double last = std::floor((middle + radius) / cell_);
      return std::pair(static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count))),
                       static_cast<int>(std::clamp(last, -1.0, count - 1.0)));
    };
    const auto [left, right] = range(centre.x() - low_.x(), columns_);
    const auto [bottom, top] = range(centre.y() - low_.y(), rows_);
    for (int row = bottom; row <= top; ++row)
      for (int column = left; column <= right; ++column) {
        const size_t c =
            static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
        for (int k = start_[c]; k < start_[c + 1]; ++k) {
          const int i = sorted_[static_cast<size_t>(k)];
          if ((Vec2(points_.row(i)) - centre).squaredNorm() < radius * radius) found.push_back(i);
        }
      }
    std::sort(found.begin(), found.end());
  }

 private:
  const Points2& points_;
  double cell_;
  Vec2 low_;
  int columns_, rows_;
  std::vector<int> start_, sorted_;
};

/// Wendland's C2 function (1 - q)^4 (4 q + 1), q in [0, 1].
double wendland(double q) { return std::pow(1 - q, 4) * (4 * q + 1); }

Vec6 quadratic_basis(const Vec2& d) {
  Vec6 p;
  p << 1, d.x(), d.y(), d.x() * d.x(), d.x() * d.y(), d.y() * d.y();
  return p;
}

/// Weights of the neighbours in the value at `centre` of the fitted quadratic:
/// w_i p(0)^T M^-1 p(d_i), M = sum w_i p p^T. False where M is nearly singular.
bool fit_weights(const Points2& points, const std::vector<int>& neighbours, const Vec2& centre,
                 double radius, std::vector<double>& weights) {
  Mat6 M = Mat6::Zero();
  weights.resize(neighbours.size());
  for (size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 d = (Vec2(points.row(neighbours[k])) - centre) / radius;
    weights[k] = wendland(d.norm());
    const Vec6 p = quadratic_basis(d);
    M += weights[k] * p * p.transpose();
  }
  const Vec6 scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Mat6> factor(Mat6(scale.asDiagonal() * M * scale.asDiagonal()));
  if (!(factor.vectorD().minCoeff() > kWorstCondition)) return false;
  const Vec6 value = scale.cwiseProduct(Vec6(factor.solve(scale.cwiseProduct(Vec6::Unit(0)))));
  for (size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 d = (Vec2(points.row(neighbours[k])) - centre) / radius;
    weights[k] *= value.dot(quadratic_basis(d));
  }
  return true;
}

}  // namespace

Transfer::Transfer(const Mesh& from, const Mesh& to)
    : rest_from_(flat_state(from)),
      rest_to_(flat_state(to)),
      weights_(to.vertex_count(), from.vertex_count()) {
  const double radius = std::sqrt(kNeighbours * from.nodal_area.mean() / kPi);
  const Grid grid(from.rest_uv, radius);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> neighbours;
  std::vector<double> weights;
  for (int v = 0; v < to.vertex_count(); ++v) {
    if (to.fixed[static_cast<size_t>(v)]) continue;
    const Vec2 centre = to.rest_uv.row(v);
    double reach = radius;
    const auto found = [&] {
      grid.list(centre, reach, neighbours);
      return neighbours.size() >= kFewestNeighbours &&
             fit_weights(from.rest_uv, neighbours, centre, reach, weights);
    };
    grid.list(centre, kFarthest * radius, neighbours);
    bool determined = !neighbours.empty() && found();
    while (!determined && !neighbours.empty() && reach < kMostGrowth * radius) {
      reach *= kGrowth;
      determined = found();
    }
    if (!determined) {
      std::ostringstream message;
      message << "transfer: around vertex " << v << " at (" << centre.x() << ", " << centre.y()
              << ") m the other mesh has too few vertices within " << reach
              << " m; meshes of one specimen are needed";
      throw std::invalid_argument(message.str());
    }
    for (size_t k = 0; k < neighbours.size(); ++k)
      entries.emplace_back(v, neighbours[k], weights[k]);
  }
  weights_.setFromTriplets(entries.begin(), entries.end());
}

VecX Transfer::operator()(const VecX& x) const {
  const VecX displacement = x - rest_from_;
  VecX result = rest_to_;
  Eigen::Map<Values>(result.data(), weights_.rows(), 3) +=
      weights_ * Eigen::Map<const Values>(displacement.data(), weights_.cols(), 3);
  return result;
}

}  // namespace drape
