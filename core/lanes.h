// A handful of doubles worked on together, as many as the processor's vectors hold: the element
// kernels take that many triangles or wings at a time, one a lane.
//
// States are padded for them: four doubles a vertex (x, y, z, unused), so that one load fetches a
// vertex and the lanes are formed by a transpose in registers.
#pragma once

#include <experimental/simd>

#include "core/types.h"

namespace drape {

using Lanes = std::experimental::native_simd<double>;
inline constexpr int kLanes = static_cast<int>(Lanes::size());

/// A 3n state or gradient with a fourth, unused row; one column a vertex.
using PaddedState = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// One 3-vector a lane.
struct Vec3Lanes {
  Lanes x, y, z;
};

inline Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3Lanes operator-(const Vec3Lanes& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3Lanes operator*(const Lanes& s, const Vec3Lanes& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Lanes dot(const Vec3Lanes& a, const Vec3Lanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// mask ? yes : no, lane by lane.
inline Lanes select(const Lanes::mask_type& mask, const Lanes& yes, Lanes no) {
  std::experimental::where(mask, no) = yes;
  return no;
}

#ifdef __AVX512F__

namespace lanes_detail {
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));
inline Four column(const PaddedState& x, int v) {
  return *reinterpret_cast<const Four*>(x.data() + 4 * static_cast<Eigen::Index>(v));
}
inline Eight pair(const PaddedState& x, int v, int w) {
  return __builtin_shufflevector(column(x, v), column(x, w), 0, 1, 2, 3, 4, 5, 6, 7);
}
inline void add(PaddedState& x, int v, Four amount) {
  *reinterpret_cast<Four*>(x.data() + 4 * static_cast<Eigen::Index>(v)) += amount;
}
}  // namespace lanes_detail

/// The positions of kLanes vertices.
inline Vec3Lanes positions(const PaddedState& x, const int* v) {
  using lanes_detail::Eight, lanes_detail::pair;
  const Eight a = pair(x, v[0], v[4]), b = pair(x, v[1], v[5]);
  const Eight c = pair(x, v[2], v[6]), d = pair(x, v[3], v[7]);
  const Eight xz_ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight xz_cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight y_ab = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight y_cd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  return {Lanes(__m512d(__builtin_shufflevector(xz_ab, xz_cd, 0, 1, 8, 9, 4, 5, 12, 13))),
          Lanes(__m512d(__builtin_shufflevector(y_ab, y_cd, 0, 1, 8, 9, 4, 5, 12, 13))),
          Lanes(__m512d(__builtin_shufflevector(xz_ab, xz_cd, 2, 3, 10, 11, 6, 7, 14, 15)))};
}

/// Adds one vector a lane to the columns of kLanes vertices, lane after lane.
inline void add_at(PaddedState& g, const int* v, const Vec3Lanes& amount) {
  using lanes_detail::Eight, lanes_detail::Four, lanes_detail::add;
  const Eight x = static_cast<__m512d>(amount.x), y = static_cast<__m512d>(amount.y);
  const Eight z = static_cast<__m512d>(amount.z), zero = {};
  const Eight xy_even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight xy_odd = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight z_even = __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight z_odd = __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight v04 = __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 4, 5, 12, 13);
  const Eight v15 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 4, 5, 12, 13);
  const Eight v26 = __builtin_shufflevector(xy_even, z_even, 2, 3, 10, 11, 6, 7, 14, 15);
  const Eight v37 = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 10, 11, 6, 7, 14, 15);
  add(g, v[0], __builtin_shufflevector(v04, v04, 0, 1, 2, 3));
  add(g, v[1], __builtin_shufflevector(v15, v15, 0, 1, 2, 3));
  add(g, v[2], __builtin_shufflevector(v26, v26, 0, 1, 2, 3));
  add(g, v[3], __builtin_shufflevector(v37, v37, 0, 1, 2, 3));
  add(g, v[4], __builtin_shufflevector(v04, v04, 4, 5, 6, 7));
  add(g, v[5], __builtin_shufflevector(v15, v15, 4, 5, 6, 7));
  add(g, v[6], __builtin_shufflevector(v26, v26, 4, 5, 6, 7));
  add(g, v[7], __builtin_shufflevector(v37, v37, 4, 5, 6, 7));
}

#else

/// The positions of kLanes vertices.
inline Vec3Lanes positions(const PaddedState& x, const int* v) {
  return {Lanes([&](int i) { return x(0, v[i]); }), Lanes([&](int i) { return x(1, v[i]); }),
          Lanes([&](int i) { return x(2, v[i]); })};
}

/// Adds one vector a lane to the columns of kLanes vertices, lane after lane.
inline void add_at(PaddedState& g, const int* v, const Vec3Lanes& amount) {
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<size_t>(i);
    g(0, v[i]) += amount.x[lane];
    g(1, v[i]) += amount.y[lane];
    g(2, v[i]) += amount.z[lane];
  }
}

#endif

/// atan2(y, x) to 2 units in the last place for finite arguments, signed zeros included: reduction
/// to |t| <= tan(pi/8), then the rational approximation of Moshier's Cephes library (atan.c).
inline Lanes atan2(const Lanes& y, const Lanes& x) {
  using std::experimental::abs, std::experimental::copysign, std::experimental::max,
      std::experimental::min, std::experimental::signbit;
  constexpr double kTanEighth = 0.41421356237309503;
  constexpr double kQuarterPi = 7.85398163397448309616e-1, kQuarterPiTail = 3.0616169978683830e-17;
  const Lanes ax = abs(x), ay = abs(y);
  const Lanes small = min(ax, ay), large = max(ax, ay);
  const Lanes::mask_type beyond = small > kTanEighth * large;  // nearer to pi/4 than to 0
  const Lanes numerator = select(beyond, small - large, small);
  const Lanes denominator = select(beyond, small + large, large);
  const Lanes t = numerator / select(denominator == 0.0, Lanes(1.0), denominator);
  const Lanes z = t * t;
  const Lanes p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                    7.500855792314704667340e1) *
                       z -
                   1.228866684490136173410e2) *
                      z -
                  6.485021904942025371773e1;
  const Lanes q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                    4.328810604912902668951e2) *
                       z +
                   4.853903996359136964868e2) *
                      z +
                  1.945506571482613964425e2;
  const Lanes r = t + t * (z * p / q);
  // angle = k pi/4 + s r
  Lanes k = select(beyond, Lanes(1.0), Lanes(0.0)), s = 1.0;
  const Lanes::mask_type steep = ay > ax, left = signbit(x);
  k = select(steep, 2.0 - k, k);
  s = select(steep, -s, s);
  k = select(left, 4.0 - k, k);
  s = select(left, -s, s);
  return copysign(k * kQuarterPi + (s * r + k * kQuarterPiTail), y);
}

}  // namespace drape
