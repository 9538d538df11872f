// The columns of schema drape-records 3: every column of a table is named here once, with its unit,
// the shape of one cell and its place in a record. Writing and reading are visits of this list.
//
// A visitor is called as visit(const Column&, place); place(row) is the value of that column in a
// row: a reference, or for a column of a const Fabric the number itself.
#pragma once

#include <functional>
#include <string>

#include "core/hdf5_file.h"
#include "core/profile.h"
#include "core/records.h"

namespace drape {

struct Column {
  std::string path;
  std::string unit = "";    ///< empty for text
  hdf5::Shape cell = {};    ///< shape of the value of one record; empty for a scalar
  std::uint64_t since = 1;  ///< version of the schema that brought it
};

/// The sizes that differ from file to file.
struct CellSizes {
  hsize_t vertices;
  hsize_t rows, columns;  ///< of the coverage image
};

/// One column a parameter. `place(row)` is a Fabric or a ParameterVector.
template <class Place, class Visit>
void visit_parameter_columns(const std::string& group, bool pure_numbers, Place place,
                             Visit&& visit, std::uint64_t since = 1) {
  for (Parameter p : all_parameters()) {
    const std::string unit(pure_numbers ? "1" : info(p).unit);
    visit({group + "/" + std::string(name(p)), unit, {}, since},
          [place, p](auto& row) -> decltype(auto) {
            auto& values = std::invoke(place, row);
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, Fabric>)
              return values[p];
            else
              return values[static_cast<int>(p)];
          });
  }
}

/// `place(row)` is a SolveStats.
template <class Place, class Visit>
void visit_stats_columns(const std::string& group, Place place, Visit&& visit) {
  const auto at = [place](auto member) {
    return [=](auto& row) -> auto& { return std::invoke(member, std::invoke(place, row)); };
  };
  visit({group + "/status"}, at(&SolveStats::status));
  visit({group + "/protocol"}, at(&SolveStats::protocol));
  visit({group + "/residual_relative", "1"}, at(&SolveStats::residual_relative));
  visit({group + "/rounding_floor", "1"}, at(&SolveStats::rounding_floor));
  visit({group + "/newton_iterations", "1"}, at(&SolveStats::newton_iterations));
  visit({group + "/factorizations", "1"}, at(&SolveStats::factorizations));
  visit({group + "/negative_eigenvalues", "1"}, at(&SolveStats::negative_eigenvalues));
  visit({group + "/wings_past_threshold", "1"}, at(&SolveStats::wings_past_threshold));
  visit({group + "/energy", "J"}, at(&SolveStats::energy));
  visit({group + "/cpu_seconds", "s"}, at(&SolveStats::cpu_seconds));
  visit({group + "/contact", "", {}, 2}, at(&SolveStats::contact));
  visit({group + "/self_intersections", "1", {}, 2}, at(&SolveStats::self_intersections));
  visit({group + "/support_penetration", "m", {}, 2}, at(&SolveStats::support_penetration));
}

/// Rows are Record. The outcome of an estimate has columns of its own, below.
template <class Visit>
void visit_record_columns(const CellSizes& sizes, Visit&& visit) {
  const auto seen = [](auto member) {
    return [=](auto& record) -> auto& { return std::invoke(member, record.observation); };
  };
  visit({"/fabric/id"}, &Record::id);
  visit({"/fabric/name"}, &Record::name);
  visit({"/fabric/category"}, &Record::category);
  visit({"/fabric/subcategory"}, &Record::subcategory);
  visit({"/fabric/type"}, &Record::type);
  visit({"/fabric/composition"}, &Record::composition);
  visit_parameter_columns("/params", false, &Record::fabric, visit);
  visit({"/sim/positions", "m", {sizes.vertices, 3}}, &Record::positions);
  visit_stats_columns("/stats", &Record::stats, visit);
  visit({"/observation/profile", "m", {kProfileSize}}, seen(&Observation::profile));
  visit({"/observation/coverage", "1", {sizes.rows, sizes.columns}}, seen(&Observation::coverage));
  visit({"/observation/drape_coefficient", "1"}, seen(&Observation::drape_coefficient));
  visit({"/observation/node_count", "1"}, seen(&Observation::node_count));
}

/// Rows are VecX: zero where contact is off. Only in files in which it acts on some record.
inline constexpr const char* kContactForce = "/sim/contact_force";
template <class Visit>
void visit_contact_columns(const CellSizes& sizes, Visit&& visit) {
  visit(
      {kContactForce, "N", {sizes.vertices, 3}}, [](auto& force) -> auto& { return force; });
}

/// Rows are EstimateRecord; a record without estimate has an empty outcome.
template <class Visit>
void visit_estimate_columns(const CellSizes& sizes, Visit&& visit) {
  visit_parameter_columns("/params_estimated", false, &EstimateRecord::fabric, visit);
  visit_parameter_columns("/params_estimated_log_sd", true, &EstimateRecord::log_sd, visit);
  visit_parameter_columns("/params_estimated_picture_share", true, &EstimateRecord::picture_share,
                          visit, 3);
  visit_parameter_columns("/params_start", false, &EstimateRecord::start, visit);
  visit({"/sim_estimated/positions", "m", {sizes.vertices, 3}}, &EstimateRecord::positions);
  visit_stats_columns("/stats_estimated", &EstimateRecord::stats, visit);
  visit({"/estimate/outcome"}, &EstimateRecord::outcome);
  visit({"/estimate/branch_shared", "1"}, &EstimateRecord::branch_shared);
  visit({"/estimate/outline_rms", "m"}, &EstimateRecord::outline_rms);
  visit({"/estimate/iou", "1"}, &EstimateRecord::iou);
  visit({"/estimate/drape_coefficient", "1"}, &EstimateRecord::drape_coefficient);
  visit({"/estimate/node_count", "1"}, &EstimateRecord::node_count);
  visit({"/estimate/forward_solves", "1"}, &EstimateRecord::forward_solves);
  visit({"/estimate/profile", "m", {kProfileSize}}, &EstimateRecord::profile);
  visit({"/estimate/start_profile", "m", {kProfileSize}}, &EstimateRecord::start_profile);
  visit({"/estimate/centre", "m", {2}, 3}, &EstimateRecord::centre);
  visit({"/estimate/weft_angle", "rad", {}, 3}, &EstimateRecord::weft_angle);
  visit({"/estimate/log_scale", "1", {}, 3}, &EstimateRecord::log_scale);
  visit({"/estimate/effective_rigidity", "N m", {3}, 3}, &EstimateRecord::rigidity);
  visit({"/estimate/effective_rigidity_log_sd", "1", {3}, 3}, &EstimateRecord::rigidity_log_sd);
}

}  // namespace drape
