// Limited-memory BFGS: a positive definite inverse Hessian, kept up to date by the last few steps.
//
// The two-loop recursion (Nocedal 1980; Nocedal and Wright, algorithm 7.4) around a given initial
// inverse H0, here a Cholesky factor of some earlier Hessian.
#pragma once

#include <array>

#include "core/types.h"

namespace drape {

class LimitedMemory {
 public:
  static constexpr int kPairs = 10;

  explicit LimitedMemory(Eigen::Index size) : s_(size, kPairs), y_(size, kPairs) {}

  void clear() { count_ = 0; }

  /// Takes a step s and the change y of the gradient along it, and forgets the oldest pair. Pairs
  /// without positive curvature are left out: the inverse must stay positive definite.
  void push(const VecX& s, const VecX& y) {
    const double curvature = s.dot(y);
    if (!(curvature > kLeastCurvature * s.norm() * y.norm())) return;
    const int slot = (first_ + count_) % kPairs;
    s_.col(slot) = s;
    y_.col(slot) = y;
    inverse_curvature_[static_cast<size_t>(slot)] = 1 / curvature;
    if (count_ < kPairs)
      ++count_;
    else
      first_ = (first_ + 1) % kPairs;
  }

  /// q <- H q, where apply_initial(q) does q <- H0 q.
  template <typename ApplyInitial>
  void apply(VecX& q, ApplyInitial apply_initial) const {
    std::array<double, kPairs> alpha;
    for (int i = count_ - 1; i >= 0; --i) {
      const int slot = (first_ + i) % kPairs;
      alpha[static_cast<size_t>(slot)] =
          inverse_curvature_[static_cast<size_t>(slot)] * s_.col(slot).dot(q);
      q -= alpha[static_cast<size_t>(slot)] * y_.col(slot);
    }
    apply_initial(q);
    for (int i = 0; i < count_; ++i) {
      const int slot = (first_ + i) % kPairs;
      const double beta = inverse_curvature_[static_cast<size_t>(slot)] * y_.col(slot).dot(q);
      q += (alpha[static_cast<size_t>(slot)] - beta) * s_.col(slot);
    }
  }

 private:
  static constexpr double kLeastCurvature = 1e-10;  // cosine between s and y

  MatX s_, y_;  // a column a pair, a ring that starts at first_
  std::array<double, kPairs> inverse_curvature_{};
  int first_ = 0, count_ = 0;
};

}  // namespace drape
