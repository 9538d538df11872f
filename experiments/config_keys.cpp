#include "experiments/config_keys.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>
#include <utility>

namespace drape {

template <>
std::vector<std::string> names_of<Kind>() {
  return {"drape",      "dataset",    "estimate", "photograph", "gradient_check",
          "robustness", "quickstart", "branches", "validation", "accuracy"};
}
template <>
std::vector<std::string> names_of<MeshKind>() {
  return {"isotropic"};
}
template <>
std::vector<std::string> names_of<FactorBackend>() {
  return {std::string(name(FactorBackend::cholmod)), std::string(name(FactorBackend::eigen))};
}
template <>
std::vector<std::string> names_of<StartProtocol>() {
  return {"coarse_ramp", "lobes", "ramp", "lowering", "guided", "ensemble"};
}
template <>
std::vector<std::string> names_of<ContactMode>() {
  return {std::string(name(ContactMode::automatic)), std::string(name(ContactMode::off)),
          std::string(name(ContactMode::support))};
}
template <>
std::vector<std::string> names_of<FitMethod>() {
  return {"levenberg_marquardt", "bfgs"};
}
template <>
std::vector<std::string> names_of<OutlineLoss>() {
  return {"profile", "coverage"};
}
template <>
std::vector<std::string> names_of<EstimateStart>() {
  return {"guided", "continued"};
}
template <>
std::vector<std::string> names_of<Structure>() {
  return {"woven", "knit", "other"};
}
template <>
std::vector<std::string> names_of<CheckedLoss>() {
  return {"profile", "coverage", "drape_coefficient"};
}
template <>
std::vector<std::string> names_of<BendingLaw>() {
  return {std::string(name(BendingLaw::tangent)), std::string(name(BendingLaw::secant))};
}
template <>
std::vector<std::string> names_of<BendingThreshold>() {
  return {std::string(name(BendingThreshold::printed)),
          std::string(name(BendingThreshold::radius))};
}
template <>
std::vector<std::string> names_of<Parameter>() {
  std::vector<std::string> names;
  for (Parameter p : all_parameters()) names.emplace_back(name(p));
  return names;
}

namespace {

constexpr double kLargestCount = 1e9;  // fits an int

// `access` returns a reference to the member, of const and of mutable Settings.
template <class Access>
ConfigKey key(std::string section, std::string key_name, std::string unit, Range range,
              std::string explanation, Access access) {
  using Member = std::remove_cvref_t<std::invoke_result_t<Access, Settings&>>;
  using Convert = Conversion<Member>;
  if constexpr (std::is_same_v<Member, int> || std::is_same_v<Member, std::vector<int>>)
    range.high = std::min(range.high, kLargestCount);
  std::vector<std::string> choices;
  if constexpr (std::is_enum_v<Member>) choices = names_of<Member>();
  if constexpr (IsEnumList<Member>::value) choices = names_of<typename Member::value_type>();
  return {std::move(section),
          std::move(key_name),
          Convert::kType,
          std::move(unit),
          range,
          std::move(choices),
          std::move(explanation),
          [access](const Settings& s) { return Convert::to_value(access(s)); },
          [access](Settings& s, const ConfigValue& v) { access(s) = Convert::from_value(v); }};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kAny{};
constexpr Range kPositive{0, kInfinity, false};
constexpr Range kNotNegative{0, kInfinity, true};
constexpr Range at_least(double low) { return {low, kInfinity, true}; }
constexpr Range kVertices{200, 1e6, true};

#define MEMBER(member) \
  [](auto& s) -> auto& { return s.member; }

std::vector<ConfigKey> make_keys() {
  std::vector<ConfigKey> keys;
  const auto add = [&](const char* section, const char* key_name, const char* unit, Range range,
                       const char* explanation, auto access) {
    keys.push_back(key(section, key_name, unit, range, explanation, access));
  };

  add("experiment", "kind", "", kAny, "What to do; the one key that must be given.",
      MEMBER(experiment.kind));
  add("experiment", "seed", "", kNotNegative,
      "Of everything random that has no seed of its own (fabrics, perturbations, noise).",
      MEMBER(experiment.seed));
  add("experiment", "threads", "", kNotNegative,
      "Number of threads; 0 means all. No result depends on it.", MEMBER(experiment.threads));

  for (Parameter p : all_parameters()) {
    const ParameterInfo& about = info(p);
    keys.push_back(key("fabric", std::string(about.name),
                       about.unit == "1" ? "" : std::string(about.unit),
                       {about.minimum, about.maximum, about.minimum_allowed},
                       "The fabric's " + std::string(about.meaning) + ".",
                       [p](auto& s) -> decltype(auto) { return s.fabric[p]; }));
  }
  add("fabric", "bending_law", "", kAny,
      "Reading of Eq. 6: scale the tangent stiffness past the threshold (the energy is smooth), or "
      "the secant stiffness (the energy jumps; for comparison).",
      MEMBER(reading.law));
  add("fabric", "bending_threshold", "", kAny,
      "Reading of Eq. 7: as printed (past when cos(delta/2) <= L/(2 R_b)), or by the radius of the "
      "bend (past when sin(delta/2) >= L/(2 R_b)).",
      MEMBER(reading.threshold));

  add("scene", "specimen_radius", "m", kPositive, "Radius of the round specimen.",
      MEMBER(scene.specimen_radius));
  add("scene", "support_radius", "m", kPositive,
      "Radius of the disc that holds the specimen; less than specimen_radius.",
      MEMBER(scene.support_radius));
  add("scene", "gravity", "m/s^2", kPositive, "Acceleration of gravity.", MEMBER(scene.gravity));
  add("scene", "column_radius", "m", kNotNegative,
      "Radius of the column below that disc, at most support_radius; 0 for the same.",
      MEMBER(scene.column_radius));
  add("scene", "contact", "", kAny,
      "Contact with the column: \"auto\" solves again with it where a drape is more than 1 mm "
      "inside (branches: never), \"support\" always solves with it, \"off\" only looks.",
      MEMBER(contact));

  add("mesh", "vertices", "", kVertices, "Number of vertices aimed at, fixed ring included.",
      MEMBER(mesh.vertices));
  add("mesh", "kind", "", kAny, "Kind of mesh; isotropic prefers no direction.", MEMBER(mesh.kind));
  add("mesh", "seed", "", kNotNegative, "Another seed, another mesh of the same kind.",
      MEMBER(mesh.seed));
  add("mesh", "rotation", "rad", kAny, "Turns the mesh under the fabric.", MEMBER(mesh.rotation));
  add("mesh", "clamp_wing_factor", "", kPositive,
      "Weight of the wings on the clamp line; 1 makes the rim too soft.",
      MEMBER(mesh.clamp_wing_factor));

  add("solver", "tolerance", "", {0, 1, false},
      "Relative residual at rest: largest nodal force over largest nodal weight.",
      MEMBER(solver.tolerance));
  add("solver", "max_iterations", "", at_least(1), "Iterations of one solve at most.",
      MEMBER(solver.max_iterations));
  add("solver", "factorization", "", kAny,
      "Sparse factorisation: CHOLMOD supernodal with METIS, or Eigen's LDLT (slower, for checks).",
      MEMBER(solver.factorization));

  add("start", "protocol", "", kAny,
      "How one of the many equilibria is chosen: gravity ramp from flat on a coarse mesh, a start "
      "folded into lobes, the ramp in careful steps on the mesh itself, a plate lowered from under "
      "it, a given outline, or the lowest in energy of an ensemble of starts.",
      MEMBER(start.protocol));
  add("start", "lobes", "", {1, 60, true}, "Number of lobes of the folded start.",
      MEMBER(start.lobes));
  add("start", "phase", "rad", kAny, "Direction of the first lobe from the weft.",
      MEMBER(start.phase));
  add("start", "seed", "", kNotNegative,
      "Of the small noise that ramp, lowering and ensemble start with.", MEMBER(start.seed));
  add("start", "plate_step", "m", kPositive, "lowering: largest step of the plate.",
      MEMBER(start.plate_step));
  add("start", "outline", "", kAny,
      "guided: CSV of an outline's corners, counter-clockwise, with a first line x,y; in metres, "
      "centred on the support.",
      MEMBER(start.outline));
  add("start", "dataset", "", kAny, "guided: a results.h5 with the outline, instead of a CSV.",
      MEMBER(start.dataset));
  add("start", "record", "", kNotNegative, "guided: which record of that dataset.",
      MEMBER(start.record));
  add("start", "guide", "", kPositive,
      "guided: strengths of the guide, released one after the other; then none.",
      MEMBER(start.guide));
  add("start", "guide_harmonics", "", {1, 180, true},
      "guided: harmonics of the outline's profile that start and guide follow.",
      MEMBER(start.guide_harmonics));
  add("start", "ramps", "", kNotNegative, "ensemble: gravity ramps, each with other noise.",
      MEMBER(start.ensemble.ramps));
  add("start", "fewest_lobes", "", {1, 60, true}, "ensemble: folded starts from this many lobes.",
      MEMBER(start.ensemble.fewest_lobes));
  add("start", "most_lobes", "", {1, 60, true}, "ensemble: up to this many.",
      MEMBER(start.ensemble.most_lobes));
  add("start", "phases", "", kNotNegative,
      "ensemble: directions of the first lobe, for each number of lobes.",
      MEMBER(start.ensemble.phases));
  add("start", "flats", "", kNotNegative, "ensemble: flat starts, each with other noise.",
      MEMBER(start.ensemble.flats));
  add("start", "same_distance", "m", kPositive,
      "ensemble: two drapes are the same when no vertex lies further apart.",
      MEMBER(start.ensemble.same_distance));

  add("dataset", "fabrics", "", at_least(1), "Number of random fabrics; a table overrides it.",
      MEMBER(dataset.fabrics));
  add("dataset", "table", "", kAny,
      "CSV of tags (id,category,subcategory,type,composition_percent,areal_density_gsm); \"\" for "
      "random fabrics.",
      MEMBER(dataset.table));
  add("dataset", "rows", "", kNotNegative, "How many rows of the table; 0 for all.",
      MEMBER(dataset.rows));
  add("dataset", "pixels", "", {16, 4096, true}, "Rows and columns of the coverage images.",
      MEMBER(dataset.pixels));
  add("dataset", "image_width", "m", kPositive, "Width and height of the coverage images.",
      MEMBER(dataset.image_width));

  add("estimate", "fabrics", "", at_least(1),
      "Number of random fabrics to recover; a dataset overrides it.", MEMBER(estimate.fabrics));
  add("estimate", "dataset", "", kAny, "A results.h5 with observations; \"\" for random fabrics.",
      MEMBER(estimate.dataset));
  add("estimate", "records", "", kNotNegative, "Which records of the dataset; [] for all.",
      MEMBER(estimate.records));
  add("estimate", "method", "", kAny,
      "Levenberg-Marquardt with forward sensitivities, or BFGS with adjoint gradients alone.",
      MEMBER(estimate.method));
  add("estimate", "loss", "", kAny, "What is compared: radial profiles or coverage images.",
      MEMBER(estimate.loss));
  add("estimate", "parameters", "", kAny, "The parameters to estimate; the others are held.",
      MEMBER(estimate.parameters));
  add("estimate", "perturbation", "", at_least(1),
      "Factor by which the start is wrong where the truth is known.",
      MEMBER(estimate.perturbation));
  add("estimate", "perturb_either_way", "", kAny,
      "Divide some parameters by that factor, chosen by the seed, instead of multiplying all.",
      MEMBER(estimate.perturb_either_way));
  add("estimate", "max_iterations", "", at_least(1), "Iterations of one fit at most.",
      MEMBER(estimate.max_iterations));
  add("estimate", "bounds", "", {1, kInfinity, false},
      "A parameter stays within this factor of its start, up and down.", MEMBER(estimate.bounds));
  add("estimate", "outline_noise", "m", kNotNegative,
      "Standard deviation of an observed radius: scales the errors of the estimates.",
      MEMBER(estimate.outline_noise));
  add("estimate", "add_noise", "", kAny,
      "Add smooth noise of that standard deviation to the profiles of a dataset.",
      MEMBER(estimate.add_noise));
  add("estimate", "prior_log_sd", "", kNotNegative,
      "Standard deviation of the prior on each log parameter about its start; 0 for no prior.",
      MEMBER(estimate.prior_log_sd));
  add("estimate", "start", "", kAny,
      "First drape of a fit: \"guided\" by the observed outline, or, where the target's "
      "equilibrium "
      "is known, \"continued\" from it (guided where that fails).",
      MEMBER(estimate.start));
  add("estimate", "guide", "", kNotNegative,
      "Strengths of the guide of a guided fit, released one after the other; then none.",
      MEMBER(estimate.guide));
  add("estimate", "guide_harmonics", "", {1, 180, true},
      "Harmonics of the profile that start and guide follow.", MEMBER(estimate.guide_harmonics));

  add("photograph", "file", "", kAny, "PNG or JPEG with one silhouette, seen from above.",
      MEMBER(photograph.file));
  add("photograph", "mm_per_pixel", "mm", kNotNegative,
      "Size of a pixel in the plane of the drape; must be given for a photograph.",
      MEMBER(photograph.mm_per_pixel));
  add("photograph", "areal_density", "kg/m^2", kNotNegative,
      "The fabric's mass per area; must be given for a photograph.",
      MEMBER(photograph.areal_density));
  add("photograph", "structure", "", kAny, "How the cloth is made, for the first parameters.",
      MEMBER(photograph.structure));
  add("photograph", "outline_noise", "m", kPositive,
      "Standard deviation of an observed radius, model error included.",
      MEMBER(photograph.outline_noise));
  add("photograph", "prior_log_sd", "", kNotNegative,
      "Standard deviation of the prior on each log parameter about the tag's; 0 for no prior.",
      MEMBER(photograph.prior_log_sd));

  add("gradient_check", "fabrics", "", at_least(1), "Number of random fabrics.",
      MEMBER(gradient_check.fabrics));
  add("gradient_check", "loss", "", kAny, "The loss whose gradient is checked.",
      MEMBER(gradient_check.loss));
  add("gradient_check", "parameters", "", kAny, "The parameters whose derivatives are checked.",
      MEMBER(gradient_check.parameters));
  add("gradient_check", "steps", "", {0, 0.1, false},
      "Steps of the central differences, of log parameters (of t_b itself).",
      MEMBER(gradient_check.steps));

  add("robustness", "fabrics", "", at_least(1),
      "Number of random fabrics: half of the measured distribution, half from a wide box.",
      MEMBER(robustness.fabrics));
  add("robustness", "vertices", "", kVertices,
      "Mesh sizes to solve them on. The first one's results.h5 is the run's, the others' are in "
      "vertices_N.",
      MEMBER(robustness.vertices));
  add("robustness", "only", "", kNotNegative,
      "Indices of the fabrics to solve (again), e.g. of a failure; [] for all.",
      MEMBER(robustness.only));

  add("quickstart", "fabrics", "", at_least(1), "Number of fabrics, from the top of the table.",
      MEMBER(quickstart.fabrics));
  add("quickstart", "table", "", kAny,
      "CSV of tags, columns as in dataset.table; must be given for the quickstart.",
      MEMBER(quickstart.table));
  add("quickstart", "photograph", "", kAny,
      "A photograph to fit as well; \"\" for none. Skipped, saying so, where it is missing.",
      MEMBER(quickstart.photograph));
  add("quickstart", "mm_per_pixel", "mm", kNotNegative, "Size of a pixel of the photograph.",
      MEMBER(quickstart.mm_per_pixel));
  add("quickstart", "areal_density", "kg/m^2", kNotNegative,
      "Mass per area of the fabric in the photograph.", MEMBER(quickstart.areal_density));

  add("validation", "slenderness", "", kPositive,
      "Lengths of the cantilever strips over (B / weight per area)^(1/3).",
      MEMBER(validation.slenderness));
  add("validation", "edge_lengths", "m", kPositive, "Edge lengths of the strips' meshes.",
      MEMBER(validation.edge_lengths));
  add("validation", "widths", "m", kPositive, "Widths of the strips.", MEMBER(validation.widths));
  add("validation", "plate_vertices", "", kVertices, "Mesh sizes of the annular plate.",
      MEMBER(validation.plate_vertices));
  add("validation", "seeds", "", at_least(1), "Meshes of every size.", MEMBER(validation.seeds));
  add("validation", "bias_vertices", "", kVertices,
      "Mesh sizes of the drapes on turned meshes; [] for none.", MEMBER(validation.bias_vertices));
  add("validation", "rotations", "", at_least(1), "Rotations of every mesh, over half a turn.",
      MEMBER(validation.rotations));

  add("accuracy", "vertices", "", kVertices, "Mesh sizes.", MEMBER(accuracy.vertices));
  add("accuracy", "reference_vertices", "", kVertices, "Mesh size of the reference drapes.",
      MEMBER(accuracy.reference_vertices));
  add("accuracy", "seeds", "", at_least(1), "Meshes of every size.", MEMBER(accuracy.seeds));
  add("accuracy", "fabrics", "", {1, 9, true}, "How many of the study's nine fabrics.",
      MEMBER(accuracy.fabrics));

  add("branches", "softest", "", kPositive,
      "Factor on the fabric's bending stiffnesses where the sweeps start and end.",
      MEMBER(branches.softest));
  add("branches", "stiffest", "", kPositive, "Factor where they turn back; more than softest.",
      MEMBER(branches.stiffest));
  add("branches", "ramp", "", kAny, "Follow the branch that the gravity ramp finds.",
      MEMBER(branches.ramp));
  add("branches", "lobes", "", {1, 60, true},
      "Follow the branches that starts folded into these many lobes find.", MEMBER(branches.lobes));
  add("branches", "largest_step", "", {0, 1, false},
      "Of the logarithm of the stiffness, in one step.", MEMBER(branches.largest_step));
  return keys;
}

#undef MEMBER

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_allowed ? value >= low : value > low) && value <= high;
}

std::string Range::text() const {
  std::ostringstream text;
  if (std::isfinite(low)) text << (low_allowed ? ">= " : "> ") << low;
  if (std::isfinite(high)) text << (std::isfinite(low) ? " and " : "") << "<= " << high;
  return text.str();
}

const std::vector<ConfigKey>& config_keys() {
  static const std::vector<ConfigKey> keys = make_keys();
  return keys;
}

const std::vector<std::string>& config_sections() {
  static const std::vector<std::string> sections = [] {
    std::vector<std::string> list;
    for (const ConfigKey& k : config_keys())
      if (list.empty() || list.back() != k.section) list.push_back(k.section);
    return list;
  }();
  return sections;
}

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const ConfigKey& k : config_keys())
    if (k.section == section) names.push_back(k.name);
  return names;
}

const ConfigKey* find_key(std::string_view section, std::string_view key_name) {
  for (const ConfigKey& k : config_keys())
    if (k.section == section && k.name == key_name) return &k;
  return nullptr;
}

std::string name(Kind kind) { return to_name(kind); }

}  // namespace drape
