// What the cells of a stability atlas come to, method by method.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drape {

/// Per method: label, counts and range of smallest residuals of outcomes, and under "axes" for
/// every value of every axis ("vertices", "membrane_to_bending", "areal_density" with the method's
/// own time step; "time_step"; "case") how many cells converged of how many. cells: as kept by the
/// kind, see kind_stability.cpp.
nlohmann::ordered_json account_of_methods(const std::vector<nlohmann::ordered_json>& cells);

/// A paragraph of a method, from its account alone: what became of its cells, at which residuals it
/// failed, and the values of the axes at which it always or never converged.
std::string sentence(const std::string& method, const nlohmann::ordered_json& account);

}  // namespace drape
