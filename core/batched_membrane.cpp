#include "core/batched_membrane.h"

#include <cmath>

namespace drape {
namespace {

using std::experimental::sqrt;

/// w_u and w_v from edge vectors: positions cancel before they are scaled.
struct Stretched {
  Stretched(const TriangleBatch& batch, const PaddedState& x) {
    const Vec3Lanes x0 = positions(x, batch.vertices[0]);
    const Vec3Lanes e1 = positions(x, batch.vertices[1]) - x0;
    const Vec3Lanes e2 = positions(x, batch.vertices[2]) - x0;
    u = batch.du1 * e1 + batch.du2 * e2;
    v = batch.dv1 * e1 + batch.dv2 * e2;
  }
  Vec3Lanes u, v;
};

template <bool kWithGradient>
double energy(const std::vector<TriangleBatch>& batches, const MembraneStiffness& k,
              const PaddedState& x, [[maybe_unused]] PaddedState* gradient) {
  Lanes sum = 0.0;
  for (const TriangleBatch& batch : batches) {
    const Stretched w(batch, x);
    const Vec3Lanes plus = w.u + w.v, minus = w.u - w.v;
    const Lanes l_u = sqrt(dot(w.u, w.u)), l_v = sqrt(dot(w.v, w.v));
    const Lanes l_rs = sqrt(0.5 * dot(plus, plus)), l_ls = sqrt(0.5 * dot(minus, minus));
    const Lanes s_u = l_u - 1.0, s_v = l_v - 1.0, s_rs = l_rs - 1.0, s_ls = l_ls - 1.0;
    sum += 0.5 * batch.area *
           (k.k_u * s_u * s_u + k.k_v * s_v * s_v + k.k_h * (s_rs * s_rs + s_ls * s_ls));
    if constexpr (kWithGradient) {
      // the force along w_RS, w_LS in terms of w_u, w_v; one division for two quotients
      const Lanes along = 1.0 / (l_u * l_v), across = k.k_h / (l_rs * l_ls);
      const Lanes f_rs = across * l_ls * s_rs, f_ls = across * l_rs * s_ls;
      const Lanes mean = 0.5 * (f_rs + f_ls), half_difference = 0.5 * (f_rs - f_ls);
      const Lanes f_u = k.k_u * along * l_v * s_u + mean, f_v = k.k_v * along * l_u * s_v + mean;
      const Vec3Lanes by_u = batch.area * (f_u * w.u + half_difference * w.v);
      const Vec3Lanes by_v = batch.area * (half_difference * w.u + f_v * w.v);
      const Vec3Lanes g1 = batch.du1 * by_u + batch.dv1 * by_v;
      const Vec3Lanes g2 = batch.du2 * by_u + batch.dv2 * by_v;
      add_at(*gradient, batch.vertices[0], -(g1 + g2));
      add_at(*gradient, batch.vertices[1], g1);
      add_at(*gradient, batch.vertices[2], g2);
    }
  }
  return reduce(sum);
}

/// The lower triangle of a symmetric 3x3 matrix a lane: xx, yx, zx, yy, zy, zz.
struct SymmetricLanes {
  Lanes e[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
};

SymmetricLanes minus_sum(const SymmetricLanes& a, const SymmetricLanes& b) {
  SymmetricLanes result;
  for (int i = 0; i < 6; ++i) result.e[i] = -(a.e[i] + b.e[i]);
  return result;
}

void add(double* values, const BlockPlace* places, const SymmetricLanes& s, bool diagonal) {
  const BlockLanes block = {
      {s.e[0], s.e[1], s.e[2]}, {s.e[1], s.e[3], s.e[4]}, {s.e[2], s.e[4], s.e[5]}};
  add_block(values, places, block, diagonal);
}

}  // namespace

double membrane_energy(const std::vector<TriangleBatch>& batches, const MembraneStiffness& k,
                       const PaddedState& x) {
  return energy<false>(batches, k, x, nullptr);
}

double add_membrane_gradient(const std::vector<TriangleBatch>& batches, const MembraneStiffness& k,
                             const PaddedState& x, PaddedState& gradient) {
  return energy<true>(batches, k, x, &gradient);
}

void add_membrane_hessian(const std::vector<TriangleBatch>& batches,
                          const std::vector<TrianglePlaces>& places, const MembraneStiffness& k,
                          const PaddedState& x, double blend, double* values) {
  for (size_t b = 0; b < batches.size(); ++b) {
    const TriangleBatch& batch = batches[b];
    const Stretched stretched(batch, x);
    SymmetricLanes H11, H21, H22;
    const auto add_direction = [&](double stiffness, const Vec3Lanes& w, const Lanes& c1,
                                   const Lanes& c2) {
      const Lanes inverse = 1.0 / sqrt(dot(w, w)), geometric = 1.0 - inverse;
      const Lanes kA = stiffness * batch.area;
      const Lanes identity = kA * select(geometric < 0.0, (1 - blend) * geometric, geometric);
      const Vec3Lanes v = (kA * inverse * inverse * inverse) * w;
      const Lanes K[6] = {v.x * w.x + identity, v.x * w.y, v.x * w.z,
                          v.y * w.y + identity, v.y * w.z, v.z * w.z + identity};
      const Lanes c11 = c1 * c1, c21 = c2 * c1, c22 = c2 * c2;
      for (int i = 0; i < 6; ++i) {
        H11.e[i] += c11 * K[i];
        H21.e[i] += c21 * K[i];
        H22.e[i] += c22 * K[i];
      }
    };
    add_direction(k.k_u, stretched.u, batch.du1, batch.du2);
    add_direction(k.k_v, stretched.v, batch.dv1, batch.dv2);
    add_direction(k.k_h, Lanes(M_SQRT1_2) * (stretched.u + stretched.v),
                  M_SQRT1_2 * (batch.du1 + batch.dv1), M_SQRT1_2 * (batch.du2 + batch.dv2));
    add_direction(k.k_h, Lanes(M_SQRT1_2) * (stretched.u - stretched.v),
                  M_SQRT1_2 * (batch.du1 - batch.dv1), M_SQRT1_2 * (batch.du2 - batch.dv2));
    // a translation changes nothing: every row of blocks sums to zero
    const SymmetricLanes H10 = minus_sum(H11, H21), H20 = minus_sum(H21, H22);
    const auto& place = places[b].block;
    add(values, place[lower_index(0, 0)], minus_sum(H10, H20), true);
    add(values, place[lower_index(1, 0)], H10, false);
    add(values, place[lower_index(1, 1)], H11, true);
    add(values, place[lower_index(2, 0)], H20, false);
    add(values, place[lower_index(2, 1)], H21, false);
    add(values, place[lower_index(2, 2)], H22, true);
  }
}

}  // namespace drape
