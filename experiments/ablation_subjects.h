// The drapes whose ingredients an ablation changes: those of one fabric with its bending scaled to
// drape coefficients asked for, and those of fabrics fitted to photographs.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/discretization.h"
#include "experiments/output_folder.h"
#include "experiments/photograph_study.h"

namespace drape {

struct AblationSubject {
  std::string name;              ///< begins the names of its items
  double drape_coefficient = 0;  ///< asked for [per cent]; not used for a photograph
  std::optional<Capture> capture;
};

/// One a drape coefficient of [ablation], then the captures that [photographs] names, if its folder
/// is there.
std::vector<AblationSubject> ablation_subjects(const Settings& settings);

/// The subject's fabric ("parameters") and, of a photograph, how it was fitted and its outline in
/// the axes of the fabric ("outline_mm", corners one after the other). Throws std::runtime_error
/// where there is none.
nlohmann::ordered_json find_fabric(const Settings& settings, const AblationSubject& subject,
                                   std::shared_ptr<const Discretization> fine,
                                   const std::shared_ptr<const Discretization>& coarse);

/// What is changed: the settings with that fabric and, of a photograph, the guided start along its
/// outline, which is written to outlines/NAME.csv of the folder.
struct SubjectSettings {
  Settings settings;
  VecX observed;  ///< radii of the photograph's outline about the support's axis [m], else empty
};
SubjectSettings settings_of(const Settings& settings, const AblationSubject& subject,
                            const nlohmann::ordered_json& about, const OutputFolder& folder);

}  // namespace drape
