// What the cells of a stability atlas come to, method by method.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drape {

/// Per method: label, counts and range of smallest residuals of outcomes, and under "axes" for
/// every value of every axis ("vertices", "membrane_to_bending", "areal_density" with the method's
/// own time step; "time_step"; "case") how many cells converged of how many. In words, "measured":
/// where it converged and what became of the others; "limits": why methods of its kind fail there,
/// where some did. cells: as kept by the kind, see kind_stability.cpp.
nlohmann::ordered_json account_of_methods(const std::vector<nlohmann::ordered_json>& cells);

/// The paragraph of a method, from its account.
std::string paragraph(const nlohmann::ordered_json& account);

}  // namespace drape
