// Explicit dynamics: symplectic Euler with viscous damping in proportion to the masses.
//
//   v <- (1 - c h) v - h M^-1 g(x),  x <- x + h v
//
// stable while h < 2 / omega, the highest frequency of M^-1 H. It is measured again and again by
// power iteration on the projected Hessian, and h is kept a little below that limit. The damping is
// near critical for the slowest motion of a drape, the swinging of its overhang (10, 20 and 80 1/s
// were slower).
#include <cmath>

#include "benchmarks/baselines/lumped_mass.h"
#include "benchmarks/baselines/methods.h"

namespace drape::baselines {
namespace {

constexpr double kDamping = 40;            // c [1/s]
constexpr double kSafety = 0.9;            // of the limit
constexpr int kStepsPerMeasurement = 500;  // of omega
constexpr int kFirstIterations = 60;       // of the power iteration
constexpr int kIterations = 12;            // and of those that continue it

/// Power iteration on M^-1/2 H(1) M^-1/2, continued from one state to the next.
class HighestFrequency {
 public:
  explicit HighestFrequency(const Potential& potential)
      : potential_(potential),
        root_mass_(potential.discretization().to_free(lumped_masses(potential)).cwiseSqrt()),
        mode_(root_mass_.size()) {
    for (Eigen::Index i = 0; i < mode_.size(); ++i)
      mode_[i] = std::sin(1.0 + static_cast<double>(i));
  }

  double operator()(const VecX& x) {  // [1/s]
    potential_.hessian(x, 1, hessian_);
    double square = 0;
    for (int i = 0; i < iterations_; ++i) {
      mode_.normalize();
      VecX image = hessian_.selfadjointView<Eigen::Lower>() * mode_.cwiseQuotient(root_mass_);
      image = image.cwiseQuotient(root_mass_);
      square = image.norm();
      mode_ = image;
    }
    iterations_ = kIterations;
    return std::sqrt(square);
  }

 private:
  const Potential& potential_;
  VecX root_mass_, mode_;
  SparseMatrix hessian_;
  int iterations_ = kFirstIterations;
};

}  // namespace

VecX explicit_dynamics(const Potential& potential, VecX x, Course& course) {
  const VecX mass = lumped_masses(potential);
  VecX v = VecX::Zero(x.size()), gradient;
  HighestFrequency omega(potential);
  double h = course.time_step(0);
  for (int i = 0;; ++i) {
    potential.energy_and_gradient(x, gradient);
    if (i > 0 && !course.go_on(x, gradient)) return x;
    if (course.own_time_step() && i % kStepsPerMeasurement == 0) h = kSafety * 2 / omega(x);
    v = (1 - kDamping * h) * v - h * gradient.cwiseQuotient(mass);
    x += h * v;
  }
}

}  // namespace drape::baselines
