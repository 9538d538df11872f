// Fits and predictions of a folder of photographs: one fabric_NN a fabric, in it one
// specimen_SS_capture_C.jpg a picture (the layout of the Cusick Drape Dataset: Gong, Mao and Wang,
// CVPR 2024; captures 1 and 2 show one face of the specimen, 3 and 4 the other).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/discretization.h"
#include "estimation/photograph.h"
#include "experiments/settings.h"

namespace drape {

struct Capture {
  int fabric, specimen, capture;
  std::filesystem::path file;

  std::string name() const;  ///< "05_01_1"
};

/// What has changed from one capture of a fabric to another.
enum class CaptureChange { placement, face, specimen };
std::string_view name(CaptureChange change);
CaptureChange change_between(const Capture& from, const Capture& to);

/// All captures of the chosen fabrics (all if none is chosen), in order of their numbers. Files
/// with other names are ignored. Throws std::invalid_argument where a chosen fabric has none.
std::vector<Capture> find_captures(const std::filesystem::path& folder,
                                   const std::vector<int>& fabrics);

/// The first capture of a fabric, then one that differs by its placement, its face, its specimen,
/// then the others: the first `count` of these.
std::vector<Capture> chosen_captures(const std::vector<Capture>& of_fabric, int count);

struct FabricCaptures {
  int fabric;
  std::vector<Capture> all, chosen;
};

/// Those of photographs.folder, as [photographs] chooses them. Throws std::invalid_argument if it
/// holds none.
std::vector<FabricCaptures> captures_by_fabric(const Settings& settings);

/// The settings with the model's bending threshold and its unknowns.
Settings with_model(Settings settings, PhotographModel model);

/// Known, or what is taken for fabrics whose weight is not known: their k are then true but for the
/// factor between the two densities.
double areal_density_of(const Settings& settings, int fabric);

/// What is seen in a picture: nodes, drape coefficient, profile [mm].
nlohmann::ordered_json seen_in(const Settings& settings, const Photograph& photograph);

/// The fit of one picture: outcome, how well it fits, parameters.
nlohmann::ordered_json fit_capture(const Settings& settings,
                                   std::shared_ptr<const Discretization> discretization,
                                   const Capture& capture);

/// The "parameters" of such a fit.
Fabric fitted_fabric(const nlohmann::ordered_json& fit);

/// The picture's outline where its fit places it, in the axes of the fabric about the axis of the
/// support (closed polygon) [m]. The view is taken for orthographic.
Points2 outline_on_fabric(const Settings& settings, const Capture& capture,
                          const nlohmann::ordered_json& fit);

/// The picture `capture` predicted from another's fit (fit_capture's, of the same model): only how
/// the picture lies is fitted, the fabric stays as it is. The branch comes from the picture.
nlohmann::ordered_json predict_capture(const Settings& settings,
                                       std::shared_ptr<const Discretization> discretization,
                                       const Capture& capture, const nlohmann::ordered_json& fit);

/// Drapes of a fitted fabric by the study's protocols, no picture given: drape coefficients, nodes.
nlohmann::ordered_json drape_by_protocols(const Settings& settings,
                                          std::shared_ptr<const Discretization> discretization,
                                          const nlohmann::ordered_json& fit);

}  // namespace drape
