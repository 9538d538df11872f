// What the robustness experiment says of its solves: counts, percentiles, classes of failure, and
// the command that solves a failed fabric again.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drape {

/// One cold drape. Absent numbers (of a solve that threw) are NaN.
struct RobustnessSolve {
  int index = 0;              ///< of the fabric, the same for any number of fabrics
  std::uint64_t seed = 0;     ///< of the fabric
  std::string distribution;   ///< see fabric_distribution.h
  int size = 0;               ///< vertices asked for
  std::string failure;        ///< empty: a certified minimum within its target; else the class
  std::string reason;         ///< of a failure, in words
  double bending_length = 0;  ///< [m]
  double residual = 0, rounding_floor = 0;
  int negative_eigenvalues = -1;
  int newton_iterations = 0;
  int factorizations = 0;
  int wings_past_threshold = 0;
  bool contact_with_support = false;
  int self_intersections = -1;  ///< -1: not known
  double cpu_seconds = 0, unit_cpu_seconds = 0;

  /// The residual that a solve has to reach.
  double target() const;
  double units() const { return cpu_seconds / unit_cpu_seconds; }
};

nlohmann::ordered_json to_json(const RobustnessSolve& solve);
/// Throws nlohmann::json::exception where a key is missing.
RobustnessSolve robustness_solve(const nlohmann::ordered_json& json);

/// Class of failure of a solve that ended with this status; empty for a certified minimum whose
/// residual is within target. `finite`: whether all of its positions are.
std::string failure_class(const RobustnessSolve& solve, const std::string& status, bool finite);

/// Counts and percentiles of some solves, without a list of failures. No NaN: null where there is
/// nothing to count.
nlohmann::ordered_json account(const std::vector<RobustnessSolve>& solves);

/// One object a failure, with the command that replays it. `run`: the folder of the run.
nlohmann::ordered_json failures(const std::vector<RobustnessSolve>& solves,
                                const std::filesystem::path& run);

/// One line a solve, for figures and spreadsheets. SI units.
std::string csv(const std::vector<RobustnessSolve>& solves);

/// The head of the table on the screen and one of its rows.
std::string table_head();
std::string table_row(const std::string& label, const nlohmann::ordered_json& account);

}  // namespace drape
