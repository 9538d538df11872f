#include "estimation/popping.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "estimation/staged_fit.h"

namespace drape {
namespace {

constexpr double kReach = 0.5;    // of a logarithm, in one step
constexpr int kBatch = 40;        // pops between looks at the best of them
constexpr double kBetter = 0.95;  // a miss over the first one
constexpr double kMuch = 0.3;     // a miss over that of the drape whose vertices are popped
constexpr int kMostPops = 250;    // of one drape
constexpr size_t kKept = 10;
constexpr double kFitTolerance = 1e-3;  // relative change of the cost
constexpr int kFitIterations = 8;

/// A drape that the search has come to.
struct Popped {
  double miss;  ///< of a fit, or that a step of the unknowns would leave
  bool fitted;
  FitState state;
};

std::vector<std::vector<int>> neighbours(const Mesh& mesh) {
  std::vector<std::vector<int>> result(static_cast<size_t>(mesh.vertex_count()));
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)  // counter-clockwise: every edge of an inner vertex once
      result[static_cast<size_t>(mesh.triangles(t, i))].push_back(mesh.triangles(t, (i + 1) % 3));
  return result;
}

/// Best-first: of all drapes at hand the one that misses least is looked at next, by a fit if its
/// miss is only predicted, and else by popping its vertices.
class PopSearch {
 public:
  PopSearch(StagedFit& fit, int max_pops) : fit_(fit), left_(max_pops) {}

  bool run() {
    const double first = fit_.largest_miss();
    best_ = {first, true, fit_.state().without_factors()};
    open_.push_back(best_);
    while (!open_.empty() && left_ > 0 && !explains_well(best_.miss) && !fit_.spent()) {
      const auto least = std::ranges::min_element(open_, {}, &Popped::miss);
      Popped next = std::move(*least);
      open_.erase(least);
      if (next.fitted)
        pop_vertices(next);
      else
        fit(std::move(next));
    }
    fit_.take_up(best_.state);
    return best_.miss < kBetter * first;
  }

 private:
  void fit(Popped next) {
    fit_.take_up(next.state);
    if (!fit_.set_guides(0)) return;
    fit_.minimise(kFitTolerance, kFitIterations);
    if (!fit_.same_nodes()) return;
    next = {fit_.largest_miss(), true, fit_.state().without_factors()};
    if (std::ranges::any_of(seen_, [&](const FitState& state) { return fit_.is_near(state); }))
      return;
    seen_.push_back(next.state);
    if (next.miss < best_.miss) best_ = next;
    open_.push_back(std::move(next));
  }

  void pop_vertices(const Popped& from) {
    fit_.take_up(from.state);
    VecX r;
    MatX jacobian;
    if (!fit_.set_guides(0) || !fit_.residuals(r, &jacobian)) return;
    const FitState whole = fit_.state();  // with factors, to solve from
    const ReachableResidual left(jacobian, from.miss, kReach);
    const double size = r.norm() / from.miss;
    std::vector<Popped> popped;
    int tried = 0;
    for (const PicturePop& pop : fit_.promising_pops()) {
      if (left_-- <= 0) break;
      fit_.take_up(whole);
      if (fit_.pop(pop) && !fit_.is_at(whole) && fit_.same_nodes() && fit_.residuals(r))
        popped.push_back({left.norm(r) / size, false, fit_.state().without_factors()});
      if (++tried % kBatch == 0 && std::ranges::any_of(popped, [&](const Popped& one) {
            return one.miss < kMuch * from.miss;
          }))
        break;
      if (tried == kMostPops) break;
    }
    std::ranges::sort(popped, {}, &Popped::miss);
    if (popped.size() > kKept) popped.resize(kKept);
    std::ranges::move(popped, std::back_inserter(open_));
  }

  StagedFit& fit_;
  int left_;
  Popped best_;
  std::vector<Popped> open_;
  std::vector<FitState> seen_;
};

}  // namespace

std::vector<Pop> poppable(const Mesh& mesh, const VecX& x, double least_height) {
  std::vector<bool> movable(static_cast<size_t>(mesh.vertex_count()));
  for (size_t v = 0; v < movable.size(); ++v) movable[v] = mesh.fixed[v] == 0;
  for (const int v : mesh.boundary) movable[static_cast<size_t>(v)] = false;
  const auto around = neighbours(mesh);
  std::vector<Pop> result;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!movable[static_cast<size_t>(v)]) continue;
    const std::vector<int>& ring = around[static_cast<size_t>(v)];
    Eigen::Matrix3Xd offsets(3, ring.size());
    for (size_t i = 0; i < ring.size(); ++i)
      offsets.col(static_cast<Eigen::Index>(i)) = x.segment<3>(3 * ring[i]) - x.segment<3>(3 * v);
    const double distance = offsets.colwise().norm().mean();
    const Vec3 mean = offsets.rowwise().mean();
    offsets.colwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(offsets * offsets.transpose());
    const Vec3 normal = axes.eigenvectors().col(0);
    const double height = normal.dot(mean);  // of the plane over the vertex
    if (std::abs(height) > least_height * distance)
      result.push_back({v, x.segment<3>(3 * v) + 2 * height * normal});
  }
  return result;
}

ReachableResidual::ReachableResidual(const MatX& jacobian, double scale, double reach)
    : scale_(scale) {
  MatX weighted(jacobian.rows() + jacobian.cols(), jacobian.cols());
  weighted << jacobian / scale, MatX::Identity(jacobian.cols(), jacobian.cols()) / reach;
  const Eigen::HouseholderQR<MatX> qr(weighted);
  range_ = qr.householderQ() * MatX::Identity(weighted.rows(), weighted.cols());
}

double ReachableResidual::norm(const VecX& residuals) const {
  VecX r = VecX::Zero(range_.rows());
  r.head(residuals.size()) = residuals / scale_;
  return scale_ * (r - range_ * (range_.transpose() * r)).norm();
}

bool pop_through(StagedFit& fit, int max_pops) { return PopSearch(fit, max_pops).run(); }

}  // namespace drape
