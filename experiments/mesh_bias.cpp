#include "experiments/mesh_bias.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>

#include "core/profile.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/statistics.h"
#include "experiments/study_fabrics.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPi = std::numbers::pi;
constexpr int kBiasFabrics = 6;  // isotropic and with a stiff weft
constexpr StartProtocol kProtocols[] = {StartProtocol::lobes, StartProtocol::coarse_ramp};

std::string protocol_name(StartProtocol protocol) {
  return protocol == StartProtocol::lobes ? "lobes" : "coarse_ramp";
}

std::string item_name(int vertices, int seed, int rotation, int fabric, StartProtocol protocol) {
  return std::to_string(vertices) + "_" + std::to_string(seed) + "_" + std::to_string(rotation) +
         "_" + std::to_string(fabric) + "_" + protocol_name(protocol);
}

/// Direction of the first fold: phase of the harmonic of the nodes [rad].
double fold_direction(const VecX& profile, int nodes) {
  const Harmonics h = harmonics(profile, std::max(nodes, 1));
  return nodes > 0 ? std::atan2(h.b[nodes], h.a[nodes]) / nodes : NAN;
}

Json drape_one(Settings settings, std::shared_ptr<const Discretization> discretization, int index,
               StartProtocol protocol) {
  const StudyFabric study = study_fabric(index);
  settings.start.protocol = protocol;
  Potential potential = make_potential(std::move(discretization), study.fabric, settings);
  const Equilibrium equilibrium = drape(settings, potential).equilibrium;
  Json item = {{"softness", study.softness},
               {"isotropic", study.isotropic},
               {"protocol", protocol_name(protocol)},
               {"status", name(equilibrium.status)},
               {"drape_cpu_seconds", equilibrium.cpu_seconds}};
  if (!equilibrium.converged()) return item;
  const Observation seen =
      observe(settings.scene, potential.mesh(), equilibrium.x, observation_grid(settings));
  item["drape_coefficient_percent"] = 100 * seen.drape_coefficient;
  item["node_count"] = seen.node_count;
  item["fold_direction"] = fold_direction(seen.profile, seen.node_count);
  return item;
}

/// |mean of exp(i n (direction - turn))| over drapes with the most frequent number n of nodes; NaN
/// for fewer than three.
double coherence(const std::vector<Json>& drapes, bool with_mesh) {
  std::map<int, std::vector<std::complex<double>>> phases;
  for (const Json& d : drapes) {
    const int n = d["node_count"];
    if (n == 0) continue;
    const double turn = with_mesh ? number(d["rotation"]) : 0;
    phases[n].push_back(std::polar(1.0, n * (number(d["fold_direction"]) - turn)));
  }
  const std::vector<std::complex<double>>* most = nullptr;
  for (const auto& [n, list] : phases)
    if (most == nullptr || list.size() > most->size()) most = &list;
  if (most == nullptr || most->size() < 3) return NAN;
  std::complex<double> sum = 0;
  for (const std::complex<double>& phase : *most) sum += phase;
  return std::abs(sum) / static_cast<double>(most->size());
}

Json table_row(const std::vector<Json>& drapes) {
  std::vector<double> all, within_seed, seed_means, with_fabric, with_mesh;
  Json nodes = Json::object();
  std::map<int, std::vector<Json>> by_seed;
  std::map<int, int> histogram;
  int converged_count = 0;
  for (const Json& d : drapes) {
    if (d["status"] != "converged") continue;
    ++converged_count;
    all.push_back(number(d["drape_coefficient_percent"]));
    ++histogram[d["node_count"].get<int>()];
    by_seed[d["seed"].get<int>()].push_back(d);
  }
  for (const auto& [count, times] : histogram) nodes[std::to_string(count)] = times;
  for (const auto& [seed, list] : by_seed) {
    std::vector<double> here;
    for (const Json& d : list) here.push_back(number(d["drape_coefficient_percent"]));
    within_seed.push_back(standard_deviation(here));
    seed_means.push_back(mean(here));
    with_fabric.push_back(coherence(list, false));
    with_mesh.push_back(coherence(list, true));
  }
  return {{"drapes", drapes.size()},
          {"converged", converged_count},
          {"mean", mean(all)},
          {"sd", standard_deviation(all)},
          {"sd_over_rotations", median(within_seed)},
          {"sd_over_seeds", standard_deviation(seed_means)},
          {"nodes", nodes},
          {"coherence_with_fabric", median(with_fabric)},
          {"coherence_with_mesh", median(with_mesh)}};
}

}  // namespace

std::vector<Json> drape_turned_meshes(const Settings& settings, const OutputFolder& folder) {
  const ValidationSettings& v = settings.validation;
  const JsonStore store(folder, "mesh_bias");
  const int protocols = static_cast<int>(std::size(kProtocols));
  const int per_mesh = kBiasFabrics * protocols;
  const auto name_of = [&](int vertices, int seed, int rotation, int i) {
    return item_name(vertices, seed, rotation, i / protocols, kProtocols[i % protocols]);
  };
  struct TurnedMesh {
    int vertices, seed, rotation;
  };
  std::vector<TurnedMesh> meshes;
  int resumed = 0;
  for (const int vertices : v.bias_vertices)
    for (int seed = 1; seed <= v.seeds; ++seed)
      for (int rotation = 0; rotation < v.rotations; ++rotation) {
        meshes.push_back({vertices, seed, rotation});
        for (int i = 0; i < per_mesh; ++i)
          resumed += store.has(name_of(vertices, seed, rotation, i));
      }
  Progress progress("mesh bias", static_cast<int>(meshes.size()) * per_mesh, resumed);
  std::vector<Json> drapes;
  for (const TurnedMesh& mesh : meshes) {
    Settings turned = settings;
    turned.mesh.seed = static_cast<std::uint64_t>(mesh.seed);
    turned.mesh.rotation =
        kPi * mesh.rotation / v.rotations;  // half a turn leaves the fabric as it was
    // the ramp's noise belongs to the vertices: the same for all turns, it would turn the folds,
    // too
    turned.start.seed = settings.start.seed + static_cast<std::uint64_t>(mesh.rotation);
    std::vector<int> missing;
    for (int i = 0; i < per_mesh; ++i)
      if (!store.has(name_of(mesh.vertices, mesh.seed, mesh.rotation, i))) missing.push_back(i);
    if (!missing.empty()) {
      const auto discretization = make_discretization(turned, mesh.vertices);
      for_each_item(
          static_cast<int>(missing.size()), settings.experiment.thread_count(), [&](int m) {
            const int i = missing[static_cast<size_t>(m)];
            Json item = drape_one(turned, discretization, i / protocols, kProtocols[i % protocols]);
            item["vertices"] = mesh.vertices;
            item["seed"] = mesh.seed;
            item["rotation"] = turned.mesh.rotation;
            store.save(name_of(mesh.vertices, mesh.seed, mesh.rotation, i), item);
            progress.advance();
          });
      if (interrupted()) return drapes;
    }
    for (int i = 0; i < per_mesh; ++i)
      drapes.push_back(store.load(name_of(mesh.vertices, mesh.seed, mesh.rotation, i)));
  }
  return drapes;
}

Json mesh_bias_table(const std::vector<Json>& drapes) {
  std::map<std::string, std::vector<Json>> groups;
  std::vector<std::string> order;
  for (const Json& d : drapes) {
    const std::string key =
        d["softness"].get<std::string>() + (d["isotropic"].get<bool>() ? "" : " anisotropic") +
        ", " + std::to_string(d["vertices"].get<int>()) + ", " + d["protocol"].get<std::string>();
    if (groups[key].empty()) order.push_back(key);
    groups[key].push_back(d);
  }
  Json table = Json::object();
  for (const std::string& key : order) table[key] = table_row(groups[key]);
  return table;
}

}  // namespace drape
