#include "core/batched_bending.h"

namespace drape {
namespace {

using std::experimental::sqrt;

/// Edge, apexes and normals of kLanes wings.
struct Wings {
  Wings(const WingBatch& batch, const PaddedState& x) {
    const Vec3Lanes x0 = positions(x, batch.vertices[0]);
    edge = positions(x, batch.vertices[1]) - x0;
    a = positions(x, batch.vertices[2]) - x0;
    b = positions(x, batch.vertices[3]) - x0;
    left = cross(edge, a);
    right = cross(b, edge);
    length = sqrt(dot(edge, edge));
    delta = atan2(length * dot(right, a), dot(left, right));
  }
  Vec3Lanes edge, a, b, left, right;
  Lanes length, delta;
};

template <bool kWithGradient>
double energy(const WingSet& wings, const PaddedState& x, [[maybe_unused]] PaddedState* gradient) {
  Lanes sum = 0.0;
  for (size_t i = 0; i < wings.batches.size(); ++i) {
    const WingBatch& batch = wings.batches[i];
    const Wings w(batch, x);
    const WingResponse response(wings.laws[i], wings.law, w.delta);
    sum += response.energy;
    if constexpr (kWithGradient) {
      const Lanes NN_left = dot(w.left, w.left), NN_right = dot(w.right, w.right);
      const Lanes q = response.moment / (w.length * NN_left * NN_right);
      const Vec3Lanes by_left = (q * NN_right) * w.left, by_right = (q * NN_left) * w.right;
      const Lanes ll = w.length * w.length;
      const Vec3Lanes g2 = ll * by_left, g3 = ll * by_right;
      const Vec3Lanes g1 = -(dot(w.a, w.edge) * by_left + dot(w.b, w.edge) * by_right);
      add_at(*gradient, batch.vertices[0], -(g1 + g2 + g3));
      add_at(*gradient, batch.vertices[1], g1);
      add_at(*gradient, batch.vertices[2], g2);
      add_at(*gradient, batch.vertices[3], g3);
    }
  }
  return reduce(sum);
}

/// block += p q^T
void add_outer(BlockLanes& block, const Vec3Lanes& p, const Vec3Lanes& q) {
  const Lanes column[3] = {q.x, q.y, q.z};
  for (int c = 0; c < 3; ++c) {
    block[c][0] += p.x * column[c];
    block[c][1] += p.y * column[c];
    block[c][2] += p.z * column[c];
  }
}

/// block += p q^T + q p^T
void add_symmetric(BlockLanes& block, const Vec3Lanes& p, const Vec3Lanes& q) {
  add_outer(block, p, q);
  add_outer(block, q, p);
}

/// result = -(a + b + c), where `kTranspose...` says which of b and c enter transposed.
template <bool kTransposeB, bool kTransposeC>
void minus_sum(BlockLanes& result, const BlockLanes& a, const BlockLanes& b, const BlockLanes& c) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] =
          -(a[i][j] + (kTransposeB ? b[j][i] : b[i][j]) + (kTransposeC ? c[j][i] : c[i][j]));
}

/// One side of the wings and what it adds to the blocks of x1 and of its apex.
struct Side {
  Side(const Vec3Lanes& normal, const Vec3Lanes& to_apex, const Lanes& turn, const Vec3Lanes& e,
       const Lanes& length)
      : inverse_N(1.0 / sqrt(dot(normal, normal))),
        n(inverse_N * normal),
        m(turn * cross(n, e)),
        s1(-dot(to_apex, e)),
        lever(length * inverse_N) {}

  /// Adds the geometric part of the block of x1, times `moment`.
  void add_edge_block(const Lanes& moment, const Lanes& inverse_length, const Vec3Lanes& e,
                      BlockLanes& H11) const {
    const Lanes s = s1 * inverse_N;
    const Lanes M11 = -(s * s + 0.5 * inverse_length * inverse_length);
    const Lanes Q11 = -(s * inverse_length);
    add_symmetric(H11, n, (moment * M11) * m + (moment * Q11) * e);
  }

  /// The apex's own block and its block with x1 (rows: apex), d1 the gradient of delta at x1.
  void add_apex_blocks(const Lanes& tangent, const Lanes& moment, const Vec3Lanes& e,
                       const Vec3Lanes& d1, BlockLanes& Hcc, BlockLanes& Hc1) const {
    const Lanes lever2 = lever * lever;
    add_symmetric(Hcc, n, (0.5 * tangent * lever2) * n - (moment * lever2) * m);
    const Vec3Lanes in_plane = (-moment * s1 * inverse_N * lever) * m;
    add_outer(Hc1, n, (tangent * lever) * d1 + in_plane);
    add_outer(Hc1, in_plane - (moment * inverse_N) * e, n);
  }

  Lanes inverse_N;
  Vec3Lanes n, m;
  Lanes s1, lever;  // lever = l/N; the gradient of delta is n s1/N at x1, n lever at the apex
};

}  // namespace

std::vector<WingLawBatch> batches_of_laws(const std::vector<WingBatch>& batches,
                                          const std::vector<WingLaw>& laws) {
  std::vector<WingLawBatch> result(batches.size());
  for (size_t i = 0; i < batches.size(); ++i)
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const int wing = batches[i].wing[lane];
      const WingLaw& law = laws[static_cast<size_t>(wing < 0 ? batches[i].wing[0] : wing)];
      result[i].stiffness[lane] = wing < 0 ? 0 : law.stiffness;
      result[i].scale[lane] = law.scale;
      result[i].threshold[lane] = law.threshold;
    }
  return result;
}

double bending_energy(const WingSet& wings, const PaddedState& x) {
  return energy<false>(wings, x, nullptr);
}

double add_bending_gradient(const WingSet& wings, const PaddedState& x, PaddedState& gradient) {
  return energy<true>(wings, x, &gradient);
}

void add_bending_hessian(const WingSet& wings, const std::vector<WingPlaces>& places,
                         const PaddedState& x, double blend, double* values) {
  for (size_t i = 0; i < wings.batches.size(); ++i) {
    const Wings w(wings.batches[i], x);
    const WingResponse response(wings.laws[i], wings.law, w.delta);
    const Lanes moment = (1 - blend) * response.moment, tangent = response.tangent;
    const Lanes inverse_length = 1.0 / w.length;
    const Vec3Lanes e = inverse_length * w.edge;
    const Side left(w.left, w.a, 1.0, e, w.length), right(w.right, w.b, -1.0, e, w.length);
    const Vec3Lanes d1 =
        (left.s1 * left.inverse_N) * left.n + (right.s1 * right.inverse_N) * right.n;

    BlockLanes H00, H10, H11 = {}, H20, H21 = {}, H22 = {}, H30, H31 = {}, H32 = {}, H33 = {};
    add_outer(H11, tangent * d1, d1);
    left.add_edge_block(moment, inverse_length, e, H11);
    right.add_edge_block(moment, inverse_length, e, H11);
    left.add_apex_blocks(tangent, moment, e, d1, H22, H21);
    right.add_apex_blocks(tangent, moment, e, d1, H33, H31);
    add_outer(H32, (tangent * right.lever) * right.n, left.lever * left.n);
    minus_sum<true, true>(H10, H11, H21, H31);
    minus_sum<false, true>(H20, H22, H21, H32);
    minus_sum<false, false>(H30, H33, H31, H32);
    minus_sum<false, false>(H00, H10, H20, H30);

    const auto& place = places[i].block;
    add_block(values, place[lower_index(0, 0)], H00, true);
    add_block(values, place[lower_index(1, 0)], H10, false);
    add_block(values, place[lower_index(1, 1)], H11, true);
    add_block(values, place[lower_index(2, 0)], H20, false);
    add_block(values, place[lower_index(2, 1)], H21, false);
    add_block(values, place[lower_index(2, 2)], H22, true);
    add_block(values, place[lower_index(3, 0)], H30, false);
    add_block(values, place[lower_index(3, 1)], H31, false);
    add_block(values, place[lower_index(3, 2)], H32, false);
    add_block(values, place[lower_index(3, 3)], H33, true);
  }
}

}  // namespace drape
