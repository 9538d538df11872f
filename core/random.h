// Random numbers that are the same on every platform and library version.
//
// std::mt19937_64 is specified bit by bit; the distributions of the standard library are not, so
// the maps to a range are ours.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace drape {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// exp of a uniform logarithm; 0 < low <= high.
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  /// Normal with mean 0 and standard deviation 1 (Box and Muller).
  double normal() {
    constexpr double kPi = 3.14159265358979323846;
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return radius * std::cos(2 * kPi * uniform());
  }
  /// -1 or +1.
  double sign() { return (engine_() >> 63) != 0 ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

/// A seed of its own for the `index`-th item of a run, so that results do not depend on which
/// worker takes it or on how many items there are (splitmix64, Steele et al. 2014).
inline std::uint64_t seed_of_item(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15ULL * (index + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace drape
