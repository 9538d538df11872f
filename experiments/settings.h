// All settings of an experiment with their defaults, as plain structs in SI units.
//
// The tables of config_common_keys.cpp and config_keys_of_kinds.cpp tie every member to a key of
// the config file, with its unit, range and meaning: `drape explain` prints them. A member without
// a row there cannot be set by a user.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/contact.h"
#include "core/ensemble.h"
#include "core/fabric.h"
#include "core/scene.h"
#include "core/sparse_factor.h"
#include "estimation/estimate.h"
#include "estimation/tag.h"

namespace drape {

enum class Kind {
  drape,
  dataset,
  estimate,
  photograph,
  photograph_set,
  gradient_check,
  robustness,
  quickstart,
  branches,
  validation,
  accuracy,
  photographs,
  identifiability,
  work_precision,
  stability,
  ablation,
  gradient_precision,
  estimation_precision,
  tag_comparison,
  paper
};

struct Experiment {
  Kind kind = Kind::drape;
  std::uint64_t seed = 1;  ///< of everything random but mesh and start
  int threads = 0;         ///< 0: all of the machine's

  int thread_count() const {
    if (threads > 0) return threads;
    const unsigned available = std::thread::hardware_concurrency();
    return available > 0 ? static_cast<int>(available) : 1;
  }
};

enum class MeshKind { isotropic };

struct MeshSettings {
  std::optional<int> vertices = 2000;  ///< none: "auto", as many as the drape needs
  double tolerance = 0.5;              ///< of "auto" [points of drape coefficient]
  MeshKind kind = MeshKind::isotropic;
  std::uint64_t seed = 1;
  double rotation = 0;  ///< of the mesh under the fabric [rad]
  double clamp_wing_factor = 2;
  double clamp_refinement = 2;  ///< edges at the rim over edges at the clamp
};

struct SolverSettings {
  double tolerance = 1e-8;  ///< relative residual
  int max_iterations = 20000;
  FactorBackend factorization = default_factor_backend();
};

enum class StartProtocol { coarse_ramp, lobes, ramp, lowering, guided, ensemble };

struct StartSettings {
  StartProtocol protocol = StartProtocol::coarse_ramp;
  int lobes = 6;
  double phase = 0;               ///< direction of the first lobe from +x [rad]
  std::uint64_t seed = 1;         ///< of the noise of ramp, lowering and ensemble
  double plate_step = 2e-3;       ///< of lowering [m]
  std::filesystem::path outline;  ///< of guided: CSV x,y [m]; empty: none
  std::filesystem::path dataset;  ///< of guided: a results.h5; empty: none
  int record = 0;                 ///< of that dataset
  std::vector<double> guide{1, 0.1, 0.01};
  int guide_harmonics = 24;
  bool settled = false;
  EnsembleOptions ensemble;  ///< its seed is `seed`
};

/// Sweeps of the bending stiffness, each from another start at the softest fabric.
struct BranchesSettings {
  double softest = 1, stiffest = 10;  ///< factors on the fabric's bending stiffnesses
  bool ramp = true;                   ///< a branch from the gravity ramp
  std::vector<int> lobes{4, 7};       ///< and one from each of these folded starts
  double largest_step = 0.05;         ///< of the logarithm
};

/// Where the random fabrics of a recovery come from.
enum class TargetFabrics {
  box,       ///< log-uniform, wide
  measured,  ///< bending and weight of 618 fabrics; stretch and shear log-uniform, each on its own
  tags,      ///< the tag model: stretch, shear and bending that go together
};

/// How wrong the first parameters of a fit are where the truth is known: all times a factor, some
/// times and some divided by it, or each times a log-uniform factor up to it, either way.
enum class Perturb { up, either_way, random };

/// How the first drape of a fit is found.
enum class EstimateStart {
  guided,     ///< from the outline alone
  continued,  ///< a known target's own equilibrium, followed to the first parameters
};

/// The first parameters of a fit: the truth perturbed, or what the weight or the tag says.
enum class FirstParameters { perturbed, weight, tag };

/// What is known of a fabric before its outline is seen.
enum class PriorKind { none, start, weight, tag };

struct EstimateSettings {
  int fabrics = 20;
  TargetFabrics distribution = TargetFabrics::box;
  std::vector<double> drape_coefficient{0, 100};  ///< of random targets, from .. to [per cent]
  std::vector<double> anisotropy{1,
                                 100};    ///< largest hinge stiffness over the smallest, from .. to
  std::vector<StartProtocol> protocols;   ///< taken in turn; empty: that of the settings
  std::vector<int> lobes{4, 5, 6, 7, 8};  ///< of the protocol lobes, drawn at random
  std::filesystem::path dataset;          ///< empty: random fabrics
  std::vector<int> records;               ///< empty: all
  FitMethod method = FitMethod::levenberg_marquardt;
  OutlineLoss loss = OutlineLoss::profile;
  std::vector<Parameter> parameters{Parameter::k_h, Parameter::k_bu, Parameter::k_bv,
                                    Parameter::k_bh};
  FirstParameters first = FirstParameters::perturbed;
  double perturbation = 2;
  Perturb perturb = Perturb::up;
  int max_iterations = 60;
  double bounds = 100;
  double outline_noise = 5e-4;  ///< [m]
  int noise_harmonics = 15;
  bool add_noise = false;
  double huber = 0;  ///< in standard deviations; 0: none
  PriorKind prior = PriorKind::none;
  double prior_log_sd = 1;            ///< of PriorKind::start
  std::filesystem::path tag_dataset;  ///< what tags tell is fitted on it; empty: the tag model
  EstimateStart start = EstimateStart::guided;
  int guide_harmonics = 24;
  std::vector<double> guide{1, 0.1, 0.01};
  int max_restarts = 8;   ///< from other first parameters where a misfit remains
  int max_moves = 50;     ///< to neighbouring branches
  int max_pops = 2000;    ///< of single vertices
  int max_solves = 3000;  ///< of one fit a picture
};

/// What fabrics a dataset without a table has.
enum class DatasetTags {
  model,   ///< tags in the numbers of Tables 1 and 2, and parameters as they suggest
  random,  ///< no tags, parameters out of a wide box
};

struct DatasetSettings {
  int fabrics = 100;
  DatasetTags tags = DatasetTags::model;
  std::filesystem::path table;       ///< of tags; empty: none
  std::filesystem::path parameters;  ///< table of tags and parameters; empty: none
  int rows = 0;                      ///< of the table; 0: all
  int shard = 1, shards = 1;         ///< which part of how many, from 1
  std::vector<int> only;             ///< indices of fabrics; empty: all of the shard
  std::vector<double> radii;         ///< of specimens [m], a table each; empty: that of the scene
  std::vector<StartProtocol> protocols;  ///< each drapes every fabric; empty: that of the settings
  int pixels = 256;
  double image_width = 0.35584;  ///< at the scene's specimen radius, others in proportion [m]
};

enum class CheckedLoss { profile, coverage, drape_coefficient };

struct GradientCheckSettings {
  int fabrics = 20;
  CheckedLoss loss = CheckedLoss::profile;
  std::vector<Parameter> parameters{all_parameters().begin(), all_parameters().end()};
  std::vector<double> steps{3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6};
};

struct RobustnessSettings {
  int fabrics = 60;
  std::vector<int> vertices{2000};
  std::vector<int> only;  ///< indices of fabrics; empty: all
};

struct QuickstartSettings {
  int fabrics = 15;
  std::filesystem::path table;
  std::filesystem::path photograph;            ///< empty: none
  double mm_per_pixel = 0, areal_density = 0;  ///< of the photograph
};

/// A set of experiments whose figures end on one page.
struct PaperSettings {
  std::vector<std::filesystem::path> configs;  ///< in the order of the figures
};

struct PhotographSettings {
  std::vector<std::filesystem::path> files;
  double mm_per_pixel = 0;   ///< [mm]; 0: not given
  double areal_density = 0;  ///< [kg/m^2]; 0: not given
  Structure structure = Structure::woven;
  std::string type, composition;  ///< of the tag, as people write them; empty: none
  double outline_noise = 2e-3;    ///< [m]; free drapes miss photographs by about 3 mm
  std::vector<double> warp_angles{0, 45, 90, 135};  ///< [deg]
  double warp_angle_sd = 25;                        ///< [deg]; 0: known
  double scale_log_sd = 0.005;                      ///< 0: known
  std::vector<double> specimen_radius_mm;           ///< of each file, or one; empty: the scene's
  double camera_height_mm = 0;                      ///< above the support; 0: orthographic
  PriorKind prior = PriorKind::weight;
};

/// Photographs of many fabrics; how they are fitted is in PhotographSettings.
struct PhotographSetSettings {
  std::filesystem::path manifest;  ///< a table, photograph_manifest.h
};

/// How the threshold of bending is read, and whether the stiffness past it is estimated.
enum class PhotographModel { printed, radius, radius_softening };

/// A folder of photographs of many fabrics; how they are fitted is in PhotographSettings.
struct PhotographsSettings {
  std::filesystem::path folder;
  std::vector<int> fabrics;  ///< empty: all
  int captures = 4;          ///< of each fabric that are fitted
  std::vector<PhotographModel> models{PhotographModel::printed};
  std::vector<int> weighed;          ///< fabrics whose areal density is known
  std::vector<double> densities;     ///< of these [kg/m^2]
  double areal_density = 0.2;        ///< taken for the others [kg/m^2]
  std::vector<int> lobes{6, 8, 10};  ///< of the starts without a picture
};

struct IdentifiabilitySettings {
  int fabrics = 60;
};

struct ValidationSettings {
  std::vector<double> slenderness{0.5, 1, 1.5, 2, 3, 4};
  std::vector<double> edge_lengths{0.006, 0.004, 0.003, 0.002, 0.0015};  ///< of strips [m]
  std::vector<double> widths{0.01, 0.02, 0.04, 0.08};                    ///< of strips [m]
  std::vector<int> plate_vertices{500, 1000, 2000, 4000, 8000};
  int seeds = 5;
  std::vector<int> bias_vertices{1000, 2000};
  int rotations = 8;
};

struct AccuracySettings {
  std::vector<int> vertices{500, 1000, 2000, 4000, 8000};
  int reference_vertices = 30000;
  int seeds = 5;
  int fabrics = 6;
};

/// Counts the table of benchmarks/baselines/methods.h.
enum class ComparedMethod {};

struct WorkPrecisionSettings {
  std::vector<int> vertices{1000};
  int seeds = 2;
  int fabrics = 3;
  std::vector<ComparedMethod> methods;  ///< empty: all
  double cpu_seconds = 3;               ///< of a run at 1000 vertices, in proportion to them [s]
};

struct StabilitySettings {
  std::vector<int> vertices{250, 500};
  std::vector<double> membrane_to_bending{1e4, 1e5, 1e6, 1e7};  ///< k_u l^2 / B, l the overhang
  std::vector<double> areal_density{0.05, 0.2, 0.8};            ///< [kg/m^2]
  std::vector<double> time_steps{1e-5, 1e-4, 1e-3, 1e-2};       ///< besides a method's own [s]
  std::vector<ComparedMethod> methods;                          ///< empty: all
  double cpu_seconds = 4;  ///< of a run at 1000 vertices, in proportion to them [s]
  std::vector<int> only;   ///< indices of cells; empty: all
};

/// Counts the table of ingredients.h.
enum class AblatedIngredient {};

struct AblationSettings {
  std::vector<double> drape_coefficients{10, 25, 40, 55, 70, 85, 95};  ///< aimed at [per cent]
  std::vector<AblatedIngredient> ingredients;                          ///< empty: all
  double outline_tolerance = 1e-3;  ///< what "auto" must keep, besides mesh.tolerance [m]
  int largest_vertices = 8000;      ///< of the mesh that judges mesh.vertices = "auto"
};

struct GradientPrecisionSettings {
  std::vector<Parameter> parameters{Parameter::k_u,  Parameter::k_h,  Parameter::k_bu,
                                    Parameter::k_bv, Parameter::k_bh, Parameter::s_bh};
  std::vector<double> tolerances{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  std::vector<double> steps{1e-1, 1e-2, 1e-3, 1e-4, 1e-5};  ///< of central differences
  std::vector<double> difference_tolerances{1e-4, 1e-6, 1e-8};
  std::vector<double> time_steps{0.01, 0.1};          ///< of the unrolled dynamics [s]
  std::vector<int> unrolled_steps{10, 30, 100, 300};  ///< after which it is truncated
  double snap_to = 10;  ///< factor on the bending up to which a snap is looked for
  std::vector<double> distances{1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5};
};

/// The ways in which kind = "estimation_precision" fits (fit_methods.h).
enum class ComparedFit {
  levenberg_marquardt,
  bfgs,
  levenberg_marquardt_differences,
  bfgs_differences,
  bobyqa,
  nelder_mead
};

struct EstimationPrecisionSettings {
  int fabrics = 6;
  int starts = 2;                    ///< of each fabric
  std::vector<ComparedFit> methods;  ///< empty: all
  double cpu_seconds = 20;           ///< of a fit at 1000 vertices, in proportion to them [s]
};

/// What tag, picture and both tell of fabrics that a learned regressor has not seen.
struct TagComparisonSettings {
  int training = 1000;  ///< fabrics that the regressor learns from
  int held_out = 40;    ///< fabrics that all are compared on
};

struct Settings {
  Experiment experiment;
  Fabric fabric;
  BendingReading reading;
  Scene scene;
  ContactMode contact = ContactMode::automatic;
  MeshSettings mesh;
  SolverSettings solver;
  StartSettings start;
  DatasetSettings dataset;
  EstimateSettings estimate;
  PhotographSettings photograph;
  PhotographSetSettings photograph_set;
  GradientCheckSettings gradient_check;
  RobustnessSettings robustness;
  QuickstartSettings quickstart;
  PaperSettings paper;
  ValidationSettings validation;
  AccuracySettings accuracy;
  WorkPrecisionSettings work_precision;
  StabilitySettings stability;
  AblationSettings ablation;
  GradientPrecisionSettings gradient_precision;
  EstimationPrecisionSettings estimation_precision;
  BranchesSettings branches;
  PhotographsSettings photographs;
  IdentifiabilitySettings identifiability;
  TagComparisonSettings tag_comparison;
};

}  // namespace drape
