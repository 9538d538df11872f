// Records that no solver made: small, and different in every value.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/profile.h"
#include "core/records.h"

namespace drape::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A fan of six triangles around a fixed hexagon's centre; the grid is not square on purpose.
inline RecordsHeader make_header() {
  RecordsHeader header;
  header.config = "[experiment]\nkind = \"drape\"  # Grüße\n";
  header.seed = 0xfedcba9876543210;
  header.git_commit = "0123abc";
  header.compiler = "g++ 12.2";
  header.mesh_id = "disc_7";
  header.rest_uv.resize(7, 2);
  header.rest_uv.row(6).setZero();
  header.triangles.resize(6, 3);
  for (int i = 0; i < 6; ++i) {
    header.rest_uv.row(i) << 0.15 * std::cos(i * M_PI / 3), 0.15 * std::sin(i * M_PI / 3);
    header.triangles.row(i) << 6, i, (i + 1) % 6;
  }
  header.fixed = {0, 0, 0, 0, 0, 0, 1};
  header.clamp_wing_factor = 1.75;
  header.scene = {0.14, 0.08, 9.81, 0.05};
  header.reading = {BendingLaw::secant, BendingThreshold::radius};
  header.grid = {5, 8, 0.05, Vec2(-0.2, -0.125)};
  return header;
}

/// Values in [0, 1), the same on every library.
struct Uniform {
  explicit Uniform(int seed) : engine(static_cast<std::uint64_t>(seed)) {}
  double operator()() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  VecX vector(Eigen::Index size) {
    return VecX::NullaryExpr(size, [this](Eigen::Index) { return (*this)(); });
  }
  std::mt19937_64 engine;
};

inline Fabric make_fabric(Uniform& uniform) {
  Fabric fabric;
  for (Parameter p : all_parameters()) fabric[p] *= 0.5 + uniform();
  return fabric;
}

inline SolveStats make_stats(Uniform& uniform, const std::string& status) {
  return {status, "gravity ramp", uniform(), uniform(), 12, 34,       1,
          56,     -uniform(),     uniform(), "off",     3,  uniform()};
}

inline Record make_record(int index, const RecordsHeader& header) {
  Uniform uniform(index);
  Record record;
  record.id = std::to_string(index);
  record.name = "wool „flannel“";
  record.category = "woven";
  record.subcategory = "twill";
  record.type = "";
  record.composition = "80 % wool, 20 % polyamide";
  record.fabric = make_fabric(uniform);
  record.positions = uniform.vector(3 * header.rest_uv.rows());
  record.stats = make_stats(uniform, "converged");
  record.observation = {
      uniform.vector(kProfileSize),
      CoverageImage::NullaryExpr(header.grid.rows, header.grid.columns,
                                 [&](Eigen::Index, Eigen::Index) { return uniform(); }),
      0.37, 7};
  record.observation.coverage(0, 0) = 0;
  record.observation.coverage(0, 1) = 1;
  return record;
}

inline EstimateRecord make_estimate(int index, const RecordsHeader& header) {
  Uniform uniform(1000 + index);
  EstimateRecord estimate;
  estimate.fabric = make_fabric(uniform);
  estimate.start = make_fabric(uniform);
  estimate.log_sd = uniform.vector(kParameterCount);
  estimate.log_sd[1] = kNaN;
  estimate.positions = uniform.vector(3 * header.rest_uv.rows());
  estimate.stats = make_stats(uniform, "stalled");
  estimate.outcome = "succeeded";
  estimate.branch_shared = index % 2 == 0;
  estimate.outline_rms = 1.5e-3;
  estimate.iou = 0.97;
  estimate.drape_coefficient = 0.42;
  estimate.node_count = 8;
  estimate.forward_solves = 21;
  estimate.profile = uniform.vector(kProfileSize);
  estimate.start_profile = uniform.vector(kProfileSize);
  estimate.picture_share = uniform.vector(kParameterCount);
  estimate.centre = uniform.vector(2);
  estimate.weft_angle = uniform();
  estimate.log_scale = uniform();
  estimate.rigidity = uniform.vector(3);
  estimate.rigidity_log_sd = uniform.vector(3);
  return estimate;
}

}  // namespace drape::test
