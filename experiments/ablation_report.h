// What the changed drapes of an ablation come to, ingredient by ingredient, and how often the rules
// of "auto" were right.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/ablation_subjects.h"
#include "experiments/ingredients.h"
#include "experiments/json_store.h"

namespace drape {

inline constexpr const char* kFabricItem = "fabric";  // parts of the names of kept items
inline constexpr const char* kContactRule = "contact_rule";
inline constexpr const char* kResolutionRule = "resolution_rule";
std::string item_name(const AblationSubject& subject, std::string_view what);

/// The rule of mesh.vertices = "auto" is held against much finer meshes: of scaled fabrics only.
bool checks_resolution(const Settings& settings, const AblationSubject& subject);

/// Of the kept items of some subjects: "fabrics" (the subjects), "ingredients" (medians over those
/// that could be followed), "contact_rule", "resolution_rule" and "cells" (an ingredient of a
/// subject each).
nlohmann::ordered_json ablation_report(const Settings& settings, const JsonStore& store,
                                       const std::vector<AblationSubject>& subjects,
                                       const std::vector<const Ingredient*>& list);

/// The "ingredients" of a report, on the standard output.
void print_ingredients(const std::string& title, const nlohmann::ordered_json& rows);

}  // namespace drape
