#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/limited_memory.h"
#include "core/random.h"

namespace drape::test {
namespace {

constexpr int kSize = 25;

VecX random_vector(Random& random) {
  VecX v(kSize);
  for (double& value : v) value = random.uniform(-1, 1);
  return v;
}

MatX random_definite_matrix(Random& random) {
  MatX A(kSize, kSize);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = random.uniform(-1, 1);
  return A * A.transpose() + MatX::Identity(kSize, kSize);
}

/// Steps s and the changes y = A s of the gradient of a quadratic function.
struct Pair {
  VecX s, y;
};
std::vector<Pair> pairs_of(const MatX& A, int count, Random& random) {
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const VecX s = random_vector(random);
    pairs.push_back({s, A * s});
  }
  return pairs;
}

LimitedMemory memory_of(const std::vector<Pair>& pairs) {
  LimitedMemory memory(kSize);
  for (const Pair& pair : pairs) memory.push(pair.s, pair.y);
  return memory;
}

/// H column by column.
MatX inverse_hessian(const LimitedMemory& memory, const MatX& H0) {
  MatX H(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    VecX q = VecX::Unit(kSize, i);
    memory.apply(q, [&](VecX& v) { v = H0 * v; });
    H.col(i) = q;
  }
  return H;
}

/// The BFGS update of a dense inverse Hessian (Nocedal and Wright, Eq. 6.17).
MatX updated(const MatX& H, const Pair& pair) {
  const double rho = 1 / pair.s.dot(pair.y);
  const MatX V = MatX::Identity(kSize, kSize) - rho * pair.y * pair.s.transpose();
  return V.transpose() * H * V + rho * pair.s * pair.s.transpose();
}

// rounding of a few products of 25 x 25 matrices whose entries are below a thousand
constexpr double kRounding = 1e-10;

TEST(LimitedMemory, WithoutPairsIsTheInitialInverse) {
  Random random(1);
  const MatX H0 = random_definite_matrix(random);
  EXPECT_EQ(inverse_hessian(LimitedMemory(kSize), H0), H0);
}

TEST(LimitedMemory, EqualsDenseBfgs) {
  Random random(2);
  const MatX A = random_definite_matrix(random), H0 = random_definite_matrix(random).inverse();
  for (const int count : {1, 2, 5, LimitedMemory::kPairs}) {
    const std::vector<Pair> pairs = pairs_of(A, count, random);
    MatX expected = H0;
    for (const Pair& pair : pairs) expected = updated(expected, pair);
    EXPECT_LE((inverse_hessian(memory_of(pairs), H0) - expected).norm(),
              kRounding * expected.norm())
        << count << " pairs";
  }
}

TEST(LimitedMemory, MeetsTheSecantConditionOfTheLastPair) {
  Random random(3);
  const MatX A = random_definite_matrix(random), H0 = random_definite_matrix(random).inverse();
  for (const int count : {1, 3, LimitedMemory::kPairs, LimitedMemory::kPairs + 7}) {
    const std::vector<Pair> pairs = pairs_of(A, count, random);
    VecX Hy = pairs.back().y;
    memory_of(pairs).apply(Hy, [&](VecX& v) { v = H0 * v; });
    EXPECT_LE((Hy - pairs.back().s).norm(), kRounding * pairs.back().s.norm()) << count << " pairs";
  }
}

TEST(LimitedMemory, IsSymmetricAndPositiveDefinite) {
  Random random(4);
  const MatX H0 = random_definite_matrix(random).inverse();
  LimitedMemory memory(kSize);
  // pairs of no common quadratic function, half of them without positive curvature
  for (int i = 0; i < 40; ++i) memory.push(random_vector(random), random_vector(random));
  const MatX H = inverse_hessian(memory, H0);
  EXPECT_LE((H - H.transpose()).norm(), kRounding * H.norm());
  EXPECT_EQ(Eigen::LLT<MatX>(H).info(), Eigen::Success);
  EXPECT_GT((H - H0).norm(), 0.1 * H0.norm());  // some pairs were taken
}

TEST(LimitedMemory, ForgetsTheOldestPair) {
  Random random(5);
  const MatX A = random_definite_matrix(random), H0 = random_definite_matrix(random).inverse();
  const std::vector<Pair> all = pairs_of(A, LimitedMemory::kPairs + 3, random);
  const std::vector<Pair> last(all.end() - LimitedMemory::kPairs, all.end());
  const MatX H = inverse_hessian(memory_of(all), H0);
  // the same pairs in the same order at other places of the ring: the same operations
  EXPECT_EQ(H, inverse_hessian(memory_of(last), H0));
  const std::vector<Pair> one_more(all.end() - LimitedMemory::kPairs - 1, all.end());
  MatX unlimited = H0;
  for (const Pair& pair : one_more) unlimited = updated(unlimited, pair);
  EXPECT_GT((H - unlimited).norm(), 1e-6 * H.norm());
}

TEST(LimitedMemory, IgnoresPairsWithoutCurvature) {
  Random random(6);
  const MatX A = random_definite_matrix(random), H0 = random_definite_matrix(random).inverse();
  const std::vector<Pair> pairs = pairs_of(A, 4, random);
  const MatX before = inverse_hessian(memory_of(pairs), H0);

  const VecX s = random_vector(random);
  VecX across = random_vector(random);
  across -= s * (s.dot(across) / s.squaredNorm());
  const std::vector<std::pair<const char*, Pair>> useless = {
      {"negative curvature", {s, -A * s}},
      {"no curvature", {s, across + 1e-11 * s}},
      {"no change of the gradient", {s, VecX::Zero(kSize)}},
      {"no step", {VecX::Zero(kSize), s}},
      {"not a number", {s, VecX::Constant(kSize, std::nan(""))}}};
  for (const auto& [what, pair] : useless) {
    LimitedMemory memory = memory_of(pairs);
    memory.push(pair.s, pair.y);
    EXPECT_EQ(inverse_hessian(memory, H0), before) << what;
  }
  LimitedMemory memory = memory_of(pairs);
  memory.push(s, across + 1e-6 * s);  // little curvature is curvature
  EXPECT_NE(inverse_hessian(memory, H0), before);
}

TEST(LimitedMemory, ClearForgetsAll) {
  Random random(7);
  const MatX A = random_definite_matrix(random), H0 = random_definite_matrix(random).inverse();
  LimitedMemory memory = memory_of(pairs_of(A, LimitedMemory::kPairs + 4, random));
  memory.clear();
  EXPECT_EQ(inverse_hessian(memory, H0), H0);
  // and starts anew as if it were fresh
  const std::vector<Pair> pairs = pairs_of(A, 3, random);
  for (const Pair& pair : pairs) memory.push(pair.s, pair.y);
  EXPECT_EQ(inverse_hessian(memory, H0), inverse_hessian(memory_of(pairs), H0));
}

}  // namespace
}  // namespace drape::test
