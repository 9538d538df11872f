#include "experiments/photograph_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <tuple>

#include "estimation/tag.h"
#include "experiments/config_names.h"
#include "experiments/json_store.h"
#include "experiments/model.h"
#include "experiments/photograph_fit.h"
#include "experiments/recovery.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHeldLogSd = 0.01;  // of parameters that a prediction holds

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

Json in_millimetres(const VecX& profile) {
  Json list = Json::array();
  for (const double radius : profile) list.push_back(std::round(1e5 * radius) / 100);
  return list;
}

Photograph read_capture(const Settings& settings, const Capture& capture) {
  return read_photograph(capture.file, 1e-3 * settings.photograph.mm_per_pixel, settings.scene);
}

Json account(const Settings& settings, const Photograph& photograph, const WarpSearch& search,
             const std::vector<Parameter>& parameters) {
  const Estimate& result = search.best;
  const PictureEstimate& drape = result.pictures.front();
  const EstimateRecord e = estimate_record(search.pictures.front(), drape, result, parameters);
  Json item;
  item["outcome"] = e.outcome;
  item["message"] = result.message;
  item["free"] = result.kappa == 0;
  item["certified"] = drape.equilibrium.converged();
  item["outline_rms_mm"] = 1e3 * e.outline_rms;
  item["iou"] = e.iou;
  item["node_count"] = e.node_count;
  item["drape_coefficient_percent"] = 100 * e.drape_coefficient;
  item["seen"] = seen_in(settings, photograph);
  for (const Parameter p : all_parameters()) item["parameters"][std::string(name(p))] = e.fabric[p];
  for (const Parameter p : parameters)
    item["log_sd"][std::string(name(p))] = e.log_sd[static_cast<int>(p)];
  for (int i = 0; i < 3; ++i) {
    item["rigidity"].push_back(e.rigidity[i]);
    item["rigidity_log_sd"].push_back(e.rigidity_log_sd[i]);
  }
  item["cost"] = result.cost;
  for (const double x : drape.placement.centre) item["centre_mm"].push_back(1e3 * x);
  item["warp_angle_deg"] = warp_degrees(drape.placement.weft_angle);
  item["scale"] = std::exp(drape.placement.log_scale);
  item["wings_past_threshold"] = e.stats.wings_past_threshold;
  item["contact"] = drape.contact.acting();
  item["contact_doubtful"] = drape.contact_doubtful;
  item["forward_solves"] = e.forward_solves;
  item["cpu_seconds"] = result.cpu_seconds;
  item["profile_mm"] = in_millimetres(e.profile);
  return item;
}

Json drape_once(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                const Fabric& fabric, const std::string& protocol) {
  Json item = {{"protocol", protocol}};
  try {
    Potential potential = make_potential(std::move(discretization), fabric, settings);
    const Equilibrium equilibrium = drape(settings, potential).equilibrium;
    item["status"] = name(equilibrium.status);
    if (!equilibrium.converged()) return item;
    const Observation seen =
        observe(settings.scene, potential.mesh(), equilibrium.x, observation_grid(settings));
    item["drape_coefficient_percent"] = 100 * seen.drape_coefficient;
    item["node_count"] = seen.node_count;
  } catch (const std::exception& error) {  // an outline that cannot be traced
    item["status"] = error.what();
  }
  return item;
}

}  // namespace

std::string Capture::name() const {
  return two_digits(fabric) + "_" + two_digits(specimen) + "_" + std::to_string(capture);
}

std::string_view name(CaptureChange change) {
  switch (change) {
    case CaptureChange::placement:
      return "placement";
    case CaptureChange::face:
      return "face";
    case CaptureChange::specimen:
      return "specimen";
  }
  return "unknown";
}

CaptureChange change_between(const Capture& from, const Capture& to) {
  if (from.specimen != to.specimen) return CaptureChange::specimen;
  const auto face = [](const Capture& c) { return c.capture <= 2; };
  return face(from) == face(to) ? CaptureChange::placement : CaptureChange::face;
}

std::vector<Capture> find_captures(const std::filesystem::path& folder,
                                   const std::vector<int>& fabrics) {
  static const std::regex pattern(
      R"(fabric_(\d{1,9})/specimen_(\d{1,9})_capture_(\d{1,9})\.(jpe?g|png))");
  std::vector<Capture> captures;
  std::set<int> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string place = std::filesystem::relative(entry.path(), folder).generic_string();
    std::smatch match;
    if (!std::regex_match(place, match, pattern)) continue;
    const Capture capture{std::stoi(match[1]), std::stoi(match[2]), std::stoi(match[3]),
                          entry.path()};
    if (!fabrics.empty() &&
        std::find(fabrics.begin(), fabrics.end(), capture.fabric) == fabrics.end())
      continue;
    captures.push_back(capture);
    found.insert(capture.fabric);
  }
  for (const int fabric : fabrics)
    if (!found.contains(fabric))
      throw std::invalid_argument("photographs.fabrics names fabric " + std::to_string(fabric) +
                                  ": " + folder.string() + " holds no fabric_" +
                                  two_digits(fabric) + "/specimen_SS_capture_C.jpg");
  std::sort(captures.begin(), captures.end(), [](const Capture& a, const Capture& b) {
    return std::tie(a.fabric, a.specimen, a.capture) < std::tie(b.fabric, b.specimen, b.capture);
  });
  return captures;
}

std::vector<Capture> chosen_captures(const std::vector<Capture>& of_fabric, int count) {
  std::vector<Capture> chosen{of_fabric.front()};
  std::vector<bool> taken(of_fabric.size(), false);
  taken[0] = true;
  const auto take = [&](auto wanted) {
    for (size_t i = 0; i < of_fabric.size(); ++i)
      if (!taken[i] && wanted(of_fabric[i])) {
        taken[i] = true;
        chosen.push_back(of_fabric[i]);
        return true;
      }
    return false;
  };
  for (const CaptureChange change :
       {CaptureChange::placement, CaptureChange::face, CaptureChange::specimen})
    take([&](const Capture& c) { return change_between(of_fabric.front(), c) == change; });
  while (take([](const Capture&) { return true; })) {
  }
  chosen.resize(std::min(chosen.size(), static_cast<size_t>(count)), of_fabric.front());
  return chosen;
}

std::vector<FabricCaptures> captures_by_fabric(const Settings& settings) {
  const PhotographsSettings& study = settings.photographs;
  std::map<int, std::vector<Capture>> groups;
  for (const Capture& capture : find_captures(study.folder, study.fabrics))
    groups[capture.fabric].push_back(capture);
  if (groups.empty())
    throw std::invalid_argument("photographs.folder: " + study.folder.string() +
                                " holds no fabric_NN/specimen_SS_capture_C.jpg");
  std::vector<FabricCaptures> fabrics;
  for (const auto& [fabric, all] : groups)
    fabrics.push_back({fabric, all, chosen_captures(all, study.captures)});
  return fabrics;
}

Settings with_model(Settings settings, PhotographModel model) {
  settings.reading.threshold =
      model == PhotographModel::printed ? BendingThreshold::printed : BendingThreshold::radius;
  if (model == PhotographModel::radius_softening)
    for (const Parameter p : {Parameter::s_bu, Parameter::s_bv, Parameter::s_bh})
      settings.estimate.parameters.push_back(p);
  return settings;
}

double areal_density_of(const Settings& settings, int fabric) {
  const PhotographsSettings& study = settings.photographs;
  const auto known = std::find(study.weighed.begin(), study.weighed.end(), fabric);
  return known == study.weighed.end()
             ? study.areal_density
             : study.densities[static_cast<size_t>(known - study.weighed.begin())];
}

Json seen_in(const Settings& settings, const Photograph& photograph) {
  return {{"node_count", node_count(photograph.profile)},
          {"drape_coefficient_percent", 100 * drape_coefficient(settings.scene, photograph.area)},
          {"profile_mm", in_millimetres(photograph.profile)}};
}

Json fit_capture(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                 const Capture& capture) {
  const Photograph photograph = read_capture(settings, capture);
  const Structure structure = settings.photograph.structure;
  const Fabric first = first_parameters(structure, areal_density_of(settings, capture.fabric));
  const Potential model = make_potential(std::move(discretization), first, settings);
  EstimateOptions options = estimate_options(settings);
  options.prior = fit_prior(settings, settings.photograph.prior, structure, first);
  return account(settings, photograph,
                 fit_pictures(settings, {picture_of(settings, model, photograph)}, first, options),
                 options.parameters);
}

Fabric fitted_fabric(const Json& fit) {
  Fabric fabric;
  for (const Parameter p : all_parameters()) fabric[p] = fit["parameters"][std::string(name(p))];
  return fabric;
}

Points2 outline_on_fabric(const Settings& settings, const Capture& capture, const Json& fit) {
  const Placement placement{1e-3 * Vec2(fit["centre_mm"][0], fit["centre_mm"][1]),
                            weft_angle(fit["warp_angle_deg"]), std::log(number(fit["scale"]))};
  return placement.unseen(read_capture(settings, capture).boundary);
}

Json predict_capture(const Settings& settings, std::shared_ptr<const Discretization> discretization,
                     const Capture& capture, const Json& fit) {
  const Photograph photograph = read_capture(settings, capture);
  const Fabric fabric = fitted_fabric(fit);
  const Potential model = make_potential(std::move(discretization), fabric, settings);
  EstimateOptions options = estimate_options(settings);
  options.prior = prior_about({options.parameters, fabric}, fabric, kHeldLogSd);
  return account(settings, photograph,
                 fit_pictures(settings, {picture_of(settings, model, photograph)}, fabric, options),
                 options.parameters);
}

Json drape_by_protocols(const Settings& settings,
                        std::shared_ptr<const Discretization> discretization, const Json& fit) {
  const Fabric fabric = fitted_fabric(fit);
  Json drapes = Json::array();
  Settings how = settings;
  for (const StartProtocol protocol :
       {StartProtocol::coarse_ramp, StartProtocol::ramp, StartProtocol::lowering}) {
    how.start.protocol = protocol;
    drapes.push_back(drape_once(how, discretization, fabric, to_name(protocol)));
  }
  for (const int lobes : settings.photographs.lobes) {
    how.start.protocol = StartProtocol::lobes;
    how.start.lobes = lobes;
    drapes.push_back(
        drape_once(how, discretization, fabric, "lobes(" + std::to_string(lobes) + ")"));
  }
  return {{"drapes", drapes}};
}

}  // namespace drape
