#include "core/potential.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/random.h"

namespace drape {
namespace {

constexpr double kGuideUnitMiss = 1e-3;  // [m], see guide.h

MembraneStiffness membrane_stiffness(const Fabric& fabric) {
  return {fabric.k_u, fabric.k_v, fabric.k_h};
}

}  // namespace

Potential::Potential(std::shared_ptr<const Discretization> discretization, const Fabric& fabric,
                     BendingReading reading, double gravity)
    : discretization_(std::move(discretization)), reading_(reading), rim_(rim_of(mesh())) {
  set_fabric(fabric);
  set_gravity(gravity);
}

void Potential::set_fabric(const Fabric& fabric) {
  validate(fabric);
  fabric_ = fabric;
  laws_.clear();
  for (const Wing& wing : mesh().wings) laws_.push_back(wing_law(wing, fabric, reading_));
}

void Potential::set_gravity(double gravity) {
  if (!std::isfinite(gravity) || gravity < 0)
    throw std::invalid_argument("gravity = " + std::to_string(gravity) +
                                ": must be finite and >= 0 m/s^2");
  gravity_ = gravity;
}

Corners3<double> Potential::triangle_corners(int triangle, const VecX& x) const {
  Corners3<double> corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = position(x, mesh().triangles(triangle, k));
  return corners;
}

Corners4<double> Potential::wing_corners(int wing, const VecX& x) const {
  Corners4<double> corners;
  for (int k = 0; k < 4; ++k)
    corners.col(k) =
        position(x, mesh().wings[static_cast<size_t>(wing)].vertices[static_cast<size_t>(k)]);
  return corners;
}

double Potential::energy(const VecX& x) const {
  const std::vector<int>& active = discretization_->active_triangles();
  const MembraneStiffness k = membrane_stiffness(fabric_);
  const int triangles = static_cast<int>(active.size());
  const int wings = static_cast<int>(mesh().wings.size());
  std::vector<double> parts(static_cast<size_t>(triangles + wings));
#pragma omp parallel
  {
#pragma omp for schedule(static) nowait
    for (int i = 0; i < triangles; ++i) {
      const int t = active[static_cast<size_t>(i)];
      parts[static_cast<size_t>(i)] =
          membrane_energy<double>(mesh().rest[static_cast<size_t>(t)], k, triangle_corners(t, x));
    }
#pragma omp for schedule(static)
    for (int w = 0; w < wings; ++w)
      parts[static_cast<size_t>(triangles + w)] =
          wing_energy(laws_[static_cast<size_t>(w)], fold_angle(wing_corners(w, x)));
  }
  double sum = 0;
  for (double part : parts) sum += part;

  double weighted_height = 0;
  for (int v = 0; v < mesh().vertex_count(); ++v)
    weighted_height += mesh().nodal_area[v] * x[3 * v + 2];
  sum += fabric_.areal_density * gravity_ * weighted_height;

  if (guide_) {
    double misses = 0;
    for (size_t i = 0; i < rim_.vertices.size(); ++i) {
      const double miss = guide_miss(*guide_, x.segment<2>(3 * rim_.vertices[i])).value;
      misses += rim_.share[i] * miss * miss;
    }
    sum += 0.5 * guide_stiffness() * misses;
  }
  if (support_)
    for (int v : discretization_->free_vertices())
      sum += support_energy(*support_, support_weight(v), position(x, v));
  return sum;
}

VecX Potential::gradient(const VecX& x) const {
  const std::vector<int>& active = discretization_->active_triangles();
  const MembraneStiffness k = membrane_stiffness(fabric_);
  const int triangles = static_cast<int>(active.size());
  const int wings = static_cast<int>(mesh().wings.size());
  std::vector<double> corners(3 * static_cast<size_t>(discretization_->element_corner_count()));
#pragma omp parallel
  {
#pragma omp for schedule(static) nowait
    for (int i = 0; i < triangles; ++i) {
      const int t = active[static_cast<size_t>(i)];
      Eigen::Map<Vec9>(corners.data() + 9 * static_cast<size_t>(i)) =
          membrane_gradient(mesh().rest[static_cast<size_t>(t)], k, triangle_corners(t, x));
    }
#pragma omp for schedule(static)
    for (int w = 0; w < wings; ++w) {
      const Corners4<double> wing = wing_corners(w, x);
      Eigen::Map<Vec12>(corners.data() + 9 * static_cast<size_t>(triangles) +
                        12 * static_cast<size_t>(w)) =
          wing_moment(laws_[static_cast<size_t>(w)], fold_angle(wing)) * fold_angle_gradient(wing);
    }
  }
  VecX g = VecX::Zero(x.size());
  for (int v : discretization_->free_vertices())
    g[3 * v + 2] = fabric_.areal_density * gravity_ * mesh().nodal_area[v];
  discretization_->gather_gradient(corners, g);
  if (guide_) g += guide_gradient(x);
  if (support_) g -= contact_force(x);
  return g;
}

VecX Potential::guide_gradient(const VecX& x) const {
  VecX g = VecX::Zero(x.size());
  for (size_t i = 0; i < rim_.vertices.size(); ++i) {
    const GuideMiss miss = guide_miss(*guide_, x.segment<2>(3 * rim_.vertices[i]));
    g.segment<2>(3 * rim_.vertices[i]) =
        guide_stiffness() * rim_.share[i] * miss.value * miss.gradient;
  }
  return g;
}

void Potential::hessian(const VecX& x, double blend, SparseMatrix& H) const {
  const std::vector<int>& active = discretization_->active_triangles();
  const MembraneStiffness k = membrane_stiffness(fabric_);
  const int triangles = static_cast<int>(active.size());
  const int wings = static_cast<int>(mesh().wings.size());
  std::vector<double> blocks(9 * static_cast<size_t>(discretization_->element_block_count()));
  const auto store = [&](const auto& element, int corners, int first_block) {
    for (int i = 0; i < corners; ++i)
      for (int j = 0; j <= i; ++j)
        Eigen::Map<Mat3>(blocks.data() +
                         9 * static_cast<size_t>(first_block + Discretization::lower_index(i, j))) =
            element.template block<3, 3>(3 * i, 3 * j);
  };
#pragma omp parallel
  {
#pragma omp for schedule(static) nowait
    for (int i = 0; i < triangles; ++i) {
      const int t = active[static_cast<size_t>(i)];
      store(membrane_hessian(mesh().rest[static_cast<size_t>(t)], k, triangle_corners(t, x), blend),
            3, discretization_->triangle_block(i));
    }
#pragma omp for schedule(static)
    for (int w = 0; w < wings; ++w) {
      const WingLaw& law = laws_[static_cast<size_t>(w)];
      const Corners4<double> wing = wing_corners(w, x);
      const double delta = fold_angle(wing);
      Vec12 d;
      Mat12 dd;
      fold_angle_derivatives(wing, d, dd);
      // E'' d d^T is never negative; the second-order term of the angle is the geometric part
      const Mat12 element =
          wing_tangent(law, delta) * d * d.transpose() + (1 - blend) * wing_moment(law, delta) * dd;
      store(element, 4, discretization_->wing_block(w));
    }
  }
  H = discretization_->hessian_pattern();
  discretization_->gather_hessian(blocks, H);
  if (guide_) add_guide_hessian(x, blend, H);
  if (support_) add_support_hessian(x, blend, H);
}

void Potential::add_guide_hessian(const VecX& x, double blend, SparseMatrix& H) const {
  for (size_t i = 0; i < rim_.vertices.size(); ++i) {
    const int v = rim_.vertices[i];
    const GuideMiss miss = guide_miss(*guide_, x.segment<2>(3 * v));
    const Eigen::Matrix2d block =
        guide_stiffness() * rim_.share[i] *
        (miss.gradient * miss.gradient.transpose() + (1 - blend) * miss.value * miss.hessian);
    H.valuePtr()[discretization_->diagonal_entry(v, 0, 0)] += block(0, 0);
    H.valuePtr()[discretization_->diagonal_entry(v, 1, 0)] += block(1, 0);
    H.valuePtr()[discretization_->diagonal_entry(v, 1, 1)] += block(1, 1);
  }
}

double Potential::support_weight(int vertex) const {
  return fabric_.areal_density * gravity_ * support_->overhang *
         std::sqrt(mesh().nodal_area[vertex]);
}

VecX Potential::contact_force(const VecX& x) const {
  VecX force = VecX::Zero(x.size());
  if (!support_) return force;
  for (int v : discretization_->free_vertices())
    force.segment<3>(3 * v) = -support_gradient(*support_, support_weight(v), position(x, v));
  return force;
}

void Potential::add_support_hessian(const VecX& x, double blend, SparseMatrix& H) const {
  for (int v : discretization_->free_vertices()) {
    if (support_penetration(*support_, position(x, v)) == 0) continue;
    const Mat3 block = support_hessian(*support_, support_weight(v), position(x, v), blend);
    for (int c = 0; c < 3; ++c)
      for (int r = c; r < 3; ++r)
        H.valuePtr()[discretization_->diagonal_entry(v, r, c)] += block(r, c);
  }
}

double Potential::guide_stiffness() const { return guide_->kappa * free_weight() / kGuideUnitMiss; }

MatX Potential::gradient_dfabric(const VecX& x) const {
  MatX dg = MatX::Zero(x.size(), kParameterCount);
  const auto is_free = [&](int v) { return mesh().fixed[static_cast<size_t>(v)] == 0; };
  for (int v : discretization_->free_vertices())
    dg(3 * v + 2, static_cast<int>(Parameter::areal_density)) = gravity_ * mesh().nodal_area[v];
  // the guide is as strong as the cloth is heavy
  if (guide_)
    dg.col(static_cast<int>(Parameter::areal_density)) += guide_gradient(x) / fabric_.areal_density;
  if (support_)  // and so is the support
    dg.col(static_cast<int>(Parameter::areal_density)) -= contact_force(x) / fabric_.areal_density;
  for (int t : discretization_->active_triangles()) {
    const Eigen::Matrix<double, 9, 3> element =
        membrane_gradient_dstiffness(mesh().rest[static_cast<size_t>(t)], triangle_corners(t, x));
    for (int k = 0; k < 3; ++k)
      if (const int v = mesh().triangles(t, k); is_free(v))
        dg.block<3, 3>(3 * v, static_cast<int>(Parameter::k_u)) += element.middleRows<3>(3 * k);
  }
  for (size_t w = 0; w < mesh().wings.size(); ++w) {
    const Corners4<double> corners = wing_corners(static_cast<int>(w), x);
    const Vec12 d = fold_angle_gradient(corners);
    const Eigen::Matrix<double, 9, 1> dM = wing_moment_dfabric(laws_[w], fold_angle(corners));
    for (size_t k = 0; k < 4; ++k)
      if (const int v = mesh().wings[w].vertices[k]; is_free(v))
        dg.block<3, 9>(3 * v, static_cast<int>(Parameter::k_bu)) +=
            d.segment<3>(3 * static_cast<Eigen::Index>(k)) * dM.transpose();
  }
  return dg;
}

ParameterVector Potential::gradient_dfabric_transposed(const VecX& x, const VecX& lambda) const {
  ParameterVector sum = ParameterVector::Zero();
  for (int v : discretization_->free_vertices())
    sum[static_cast<int>(Parameter::areal_density)] +=
        lambda[3 * v + 2] * gravity_ * mesh().nodal_area[v];
  if (guide_)
    sum[static_cast<int>(Parameter::areal_density)] +=
        lambda.dot(guide_gradient(x)) / fabric_.areal_density;
  if (support_)
    sum[static_cast<int>(Parameter::areal_density)] -=
        lambda.dot(contact_force(x)) / fabric_.areal_density;
  for (int t : discretization_->active_triangles()) {
    Vec9 at_corners;
    for (int k = 0; k < 3; ++k)
      at_corners.segment<3>(3 * k) = position(lambda, mesh().triangles(t, k));
    sum.segment<3>(static_cast<int>(Parameter::k_u)) +=
        membrane_gradient_dstiffness(mesh().rest[static_cast<size_t>(t)], triangle_corners(t, x))
            .transpose() *
        at_corners;
  }
  for (size_t w = 0; w < mesh().wings.size(); ++w) {
    const Corners4<double> corners = wing_corners(static_cast<int>(w), x);
    const double rate =
        fold_angle_gradient(corners).dot(wing_corners(static_cast<int>(w), lambda).reshaped());
    sum.segment<9>(static_cast<int>(Parameter::k_bu)) +=
        rate * wing_moment_dfabric(laws_[w], fold_angle(corners));
  }
  return sum;
}

double Potential::largest_nodal_weight() const {
  return fabric_.areal_density * gravity_ * mesh().nodal_area.maxCoeff();
}

double Potential::free_weight() const {
  double area = 0;
  for (int v : discretization_->free_vertices()) area += mesh().nodal_area[v];
  return fabric_.areal_density * gravity_ * area;
}

double Potential::residual(const VecX& gradient) const {
  double largest = 0;
  for (int v : discretization_->free_vertices()) {
    const double force = position(gradient, v).norm();
    if (!std::isfinite(force)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, force);
  }
  return largest / largest_nodal_weight();
}

double Potential::rounding_floor(const VecX& x) const {
  Random random(1);
  VecX moved = x;
  for (int v : discretization_->free_vertices())
    for (int k = 3 * v; k < 3 * v + 3; ++k)
      moved[k] = std::nextafter(x[k], random.sign() * std::numeric_limits<double>::infinity());
  return residual(gradient(moved) - gradient(x));
}

std::vector<bool> Potential::wing_regimes(const VecX& x) const {
  std::vector<bool> past(laws_.size());
  for (size_t w = 0; w < laws_.size(); ++w)
    past[w] = past_threshold(laws_[w], fold_angle(wing_corners(static_cast<int>(w), x)));
  return past;
}

int Potential::wings_past_threshold(const VecX& x) const {
  int count = 0;
  for (bool past : wing_regimes(x)) count += past;
  return count;
}

}  // namespace drape
