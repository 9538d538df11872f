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

/// Padded states of the evaluation at hand, kept by each thread: evaluations allocate nothing.
PaddedState& padded(const VecX& x) {
  thread_local PaddedState state;
  state.resize(Eigen::NoChange, x.size() / 3);
  state.topRows<3>() = x.reshaped(3, x.size() / 3);
  return state;
}

PaddedState& zero_gradient(Eigen::Index vertices) {
  thread_local PaddedState gradient;
  gradient.setZero(4, vertices);
  return gradient;
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
  law_batches_ = batches_of_laws(discretization_->wing_batches(), laws_);
  weigh();
}

void Potential::set_gravity(double gravity) {
  if (!std::isfinite(gravity) || gravity < 0)
    throw std::invalid_argument("gravity = " + std::to_string(gravity) +
                                ": must be finite and >= 0 m/s^2");
  gravity_ = gravity;
  weigh();
}

void Potential::weigh() {
  weight_ = VecX::Zero(3 * mesh().vertex_count());
  for (int v = 0; v < mesh().vertex_count(); ++v)
    weight_[3 * v + 2] = fabric_.areal_density * gravity_ * mesh().nodal_area[v];
}

WingSet Potential::wings() const {
  return {discretization_->wing_batches(), law_batches_, reading_.law};
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
  const PaddedState& positions = padded(x);
  return membrane_energy(discretization_->triangle_batches(), membrane_stiffness(fabric_),
                         positions) +
         bending_energy(wings(), positions) + vertex_energy(x);
}

double Potential::energy_and_gradient(const VecX& x, VecX& gradient) const {
  const PaddedState& positions = padded(x);
  PaddedState& sum = zero_gradient(mesh().vertex_count());
  double energy = add_membrane_gradient(discretization_->triangle_batches(),
                                        membrane_stiffness(fabric_), positions, sum);
  energy += add_bending_gradient(wings(), positions, sum);
  gradient.setZero(x.size());
  for (int v : discretization_->free_vertices()) gradient.segment<3>(3 * v) = sum.col(v).head<3>();
  add_vertex_gradient(x, gradient);
  return energy + vertex_energy(x);
}

VecX Potential::gradient(const VecX& x) const {
  VecX gradient;
  energy_and_gradient(x, gradient);
  return gradient;
}

void Potential::hessian(const VecX& x, double blend, SparseMatrix& H) const {
  const PaddedState& positions = padded(x);
  discretization_->reset_hessian(H);
  add_membrane_hessian(discretization_->triangle_batches(), discretization_->triangle_places(),
                       membrane_stiffness(fabric_), positions, blend, H.valuePtr());
  add_bending_hessian(wings(), discretization_->wing_places(), positions, blend, H.valuePtr());
  add_vertex_hessian(x, blend, H);
}

double Potential::vertex_energy(const VecX& x) const {
  double energy = weight_.dot(x);
  if (guide_) {
    double misses = 0;
    for (size_t i = 0; i < rim_.vertices.size(); ++i) {
      const double miss = guide_miss(*guide_, x.segment<2>(3 * rim_.vertices[i])).value;
      misses += rim_.share[i] * miss * miss;
    }
    energy += 0.5 * guide_stiffness() * misses;
  }
  if (plate_)
    for (int v : discretization_->free_vertices())
      energy += weight_[3 * v + 2] * plate_push(*plate_, x[3 * v + 2]).energy;
  if (support_)
    for (int v : discretization_->free_vertices())
      energy += support_energy(*support_, support_weight(v), position(x, v));
  return energy;
}

void Potential::add_vertex_gradient(const VecX& x, VecX& gradient) const {
  for (int v : discretization_->free_vertices()) gradient[3 * v + 2] += weight_[3 * v + 2];
  if (guide_) {
    const double stiffness = guide_stiffness();
    for (size_t i = 0; i < rim_.vertices.size(); ++i) {
      const GuideMiss miss = guide_miss(*guide_, x.segment<2>(3 * rim_.vertices[i]));
      gradient.segment<2>(3 * rim_.vertices[i]) +=
          stiffness * rim_.share[i] * miss.value * miss.gradient;
    }
  }
  if (plate_)
    for (int v : discretization_->free_vertices())
      gradient[3 * v + 2] += weight_[3 * v + 2] * plate_push(*plate_, x[3 * v + 2]).slope;
  if (support_)
    for (int v : discretization_->free_vertices())
      gradient.segment<3>(3 * v) += support_gradient(*support_, support_weight(v), position(x, v));
}

void Potential::add_vertex_hessian(const VecX& x, double blend, SparseMatrix& H) const {
  const auto add = [&](int v, const auto& block) {
    for (int c = 0; c < block.cols(); ++c)
      for (int r = c; r < block.rows(); ++r)
        H.valuePtr()[discretization_->diagonal_entry(v, r, c)] += block(r, c);
  };
  if (guide_) {
    const double stiffness = guide_stiffness();
    for (size_t i = 0; i < rim_.vertices.size(); ++i) {
      const GuideMiss miss = guide_miss(*guide_, x.segment<2>(3 * rim_.vertices[i]));
      const Eigen::Matrix2d block =
          stiffness * rim_.share[i] *
          (miss.gradient * miss.gradient.transpose() + (1 - blend) * miss.value * miss.hessian);
      add(rim_.vertices[i], block);
    }
  }
  if (plate_)
    for (int v : discretization_->free_vertices())
      H.valuePtr()[discretization_->diagonal_entry(v, 2, 2)] +=
          weight_[3 * v + 2] * plate_push(*plate_, x[3 * v + 2]).curvature;
  if (support_)
    for (int v : discretization_->free_vertices())
      if (support_penetration(*support_, position(x, v)) > 0)
        add(v, support_hessian(*support_, support_weight(v), position(x, v), blend));
}

VecX Potential::vertex_gradient_ddensity(const VecX& x) const {
  VecX g = VecX::Zero(x.size());
  add_vertex_gradient(x, g);
  return g / fabric_.areal_density;
}

double Potential::guide_stiffness() const { return guide_->kappa * free_weight() / kGuideUnitMiss; }

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

MatX Potential::gradient_dfabric(const VecX& x) const {
  MatX dg = MatX::Zero(x.size(), kParameterCount);
  const auto is_free = [&](int v) { return mesh().fixed[static_cast<size_t>(v)] == 0; };
  dg.col(static_cast<int>(Parameter::areal_density)) = vertex_gradient_ddensity(x);
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
  sum[static_cast<int>(Parameter::areal_density)] = lambda.dot(vertex_gradient_ddensity(x));
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
