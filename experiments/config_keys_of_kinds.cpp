#include "experiments/config_key_list.h"

namespace drape {

void add_keys_of_kinds(ConfigKeyList& add) {
  add("dataset", "fabrics", "", at_least(1),
      "Number of fabrics, of all shards; a table overrides it. 5145 is the whole set.",
      DRAPE_MEMBER(dataset.fabrics));
  add("dataset", "tags", "", kAny,
      "Fabrics without a table: \"model\" draws tags in the numbers of Tables 1 and 2 of Ju et al. "
      "and parameters that such tags suggest; \"random\" fabrics are out of a wide box.",
      DRAPE_MEMBER(dataset.tags));
  add("dataset", "table", "", kAny,
      "CSV of tags (id,category,subcategory,type,composition_percent,areal_density_gsm) that get "
      "their first parameters; \"\" for none.",
      DRAPE_MEMBER(dataset.table));
  add("dataset", "parameters", "", kAny,
      "CSV of tags and parameters in the units of the garment software (g, mm, s): columns id, "
      "density, fSuK, fSvK, fHK, fBuK, fBvK, fBhK and more; \"\" for none.",
      DRAPE_MEMBER(dataset.parameters));
  add("dataset", "rows", "", kNotNegative, "How many rows of the table; 0 for all.",
      DRAPE_MEMBER(dataset.rows));
  add("dataset", "shard", "", at_least(1),
      "Which of the shards this run drapes, from 1; --shard K/N sets both.",
      DRAPE_MEMBER(dataset.shard));
  add("dataset", "shards", "", at_least(1),
      "How many parts the set is cut into; drape dataset merge puts them together.",
      DRAPE_MEMBER(dataset.shards));
  add("dataset", "only", "", kNotNegative,
      "Indices of the fabrics to drape (again), e.g. of a failure; [] for all of the shard.",
      DRAPE_MEMBER(dataset.only));
  add("dataset", "radii", "m", kPositive,
      "Radii of the specimens cut from every fabric: a table each, the first in results.h5, the "
      "others in radius_NNNmm/; [] for scene.specimen_radius.",
      DRAPE_MEMBER(dataset.radii));
  add("dataset", "protocols", "", kAny,
      "Start protocols, each of which drapes every fabric: a record each, ID:PROTOCOL; [] for "
      "start.protocol.",
      DRAPE_MEMBER(dataset.protocols));
  add("dataset", "pixels", "", {16, 4096, true}, "Rows and columns of the coverage images.",
      DRAPE_MEMBER(dataset.pixels));
  add("dataset", "image_width", "m", kPositive,
      "Width and height of the coverage images; with dataset.radii at scene.specimen_radius, "
      "others "
      "in proportion.",
      DRAPE_MEMBER(dataset.image_width));

  add("estimate", "fabrics", "", at_least(1),
      "Number of random fabrics to recover; a dataset overrides it.",
      DRAPE_MEMBER(estimate.fabrics));
  add("estimate", "distribution", "", kAny,
      "Random fabrics: a wide box, bending measured on 618 fabrics, or the model of tags.",
      DRAPE_MEMBER(estimate.distribution));
  add("estimate", "drape_coefficient", "per cent", {0, 100, true},
      "From .. to: random fabrics that drape outside are drawn again.",
      DRAPE_MEMBER(estimate.drape_coefficient));
  add("estimate", "anisotropy", "", at_least(1),
      "From .. to: largest bending stiffness over the smallest; others are drawn again.",
      DRAPE_MEMBER(estimate.anisotropy));
  add("estimate", "protocols", "", kAny,
      "Start protocols of the random targets, taken in turn; [] for start.protocol.",
      DRAPE_MEMBER(estimate.protocols));
  add("estimate", "lobes", "", {1, 60, true},
      "Numbers of lobes that the protocol lobes draws from, with a random phase.",
      DRAPE_MEMBER(estimate.lobes));
  add("estimate", "dataset", "", kAny, "A results.h5 with observations; \"\" for random fabrics.",
      DRAPE_MEMBER(estimate.dataset));
  add("estimate", "records", "", kNotNegative, "Which records of the dataset; [] for all.",
      DRAPE_MEMBER(estimate.records));
  add("estimate", "method", "", kAny,
      "Levenberg-Marquardt with forward sensitivities, or BFGS with adjoint gradients alone.",
      DRAPE_MEMBER(estimate.method));
  add("estimate", "loss", "", kAny,
      "What is compared: radial profiles, coverage images, or outlines that need not be "
      "star-shaped "
      "by the signed distances of the observed one's points.",
      DRAPE_MEMBER(estimate.loss));
  add("estimate", "parameters", "", kAny, "The parameters to estimate; the others are held.",
      DRAPE_MEMBER(estimate.parameters));
  add("estimate", "first", "", kAny,
      "First parameters of a fit: the truth \"perturbed\" (estimate.perturb), or without knowing "
      "it what the \"weight\" or the \"tag\" of the record says.",
      DRAPE_MEMBER(estimate.first));
  add("estimate", "perturbation", "", at_least(1),
      "Largest factor by which the start is wrong where the truth is known.",
      DRAPE_MEMBER(estimate.perturbation));
  add("estimate", "perturb", "", kAny,
      "Every unknown times that factor (\"up\"), times or divided by it (\"either_way\"), or times "
      "a log-uniform factor from its inverse to it (\"random\"); by the seed.",
      DRAPE_MEMBER(estimate.perturb));
  add("estimate", "max_iterations", "", at_least(1), "Iterations of one fit at most.",
      DRAPE_MEMBER(estimate.max_iterations));
  add("estimate", "bounds", "", {1, kInfinity, false},
      "A parameter stays within this factor of its start, up and down.",
      DRAPE_MEMBER(estimate.bounds));
  add("estimate", "outline_noise", "m", kNotNegative,
      "Standard deviation of an observed radius: scales the errors of the estimates.",
      DRAPE_MEMBER(estimate.outline_noise));
  add("estimate", "add_noise", "", kAny,
      "Add smooth noise of that standard deviation to the profiles of a dataset.",
      DRAPE_MEMBER(estimate.add_noise));
  add("estimate", "noise_harmonics", "", {0, 179, true},
      "The errors of the radii fill the harmonics from 0 to this one: a profile has 2 n + 1 "
      "independent values.",
      DRAPE_MEMBER(estimate.noise_harmonics));
  add("estimate", "huber", "", kNotNegative,
      "Misses of a radius beyond this many standard deviations count linearly; 0 for none.",
      DRAPE_MEMBER(estimate.huber));
  add("estimate", "prior", "", kAny,
      "What is known before the outline is seen: nothing, each parameter about its start "
      "(prior_log_sd), or what the structure and the weight or the whole tag say, correlations "
      "included.",
      DRAPE_MEMBER(estimate.prior));
  add("estimate", "prior_log_sd", "", kPositive,
      "prior = \"start\": standard deviation of each log parameter about its start.",
      DRAPE_MEMBER(estimate.prior_log_sd));
  add("estimate", "tag_dataset", "", kAny,
      "first or prior = \"tag\": what a tag tells is a regression on the fabrics of this "
      "results.h5, which should be others than those estimated; \"\" for the tag model.",
      DRAPE_MEMBER(estimate.tag_dataset));
  add("estimate", "start", "", kAny,
      "First drape of a fit: \"guided\" by the observed outline, or, where the target's "
      "equilibrium "
      "is known, \"continued\" from it (guided where that fails).",
      DRAPE_MEMBER(estimate.start));
  add("estimate", "guide", "", kNotNegative,
      "Strengths of the guide of a guided fit, released one after the other; then none.",
      DRAPE_MEMBER(estimate.guide));
  add("estimate", "guide_harmonics", "", {1, 180, true},
      "Harmonics of the profile that start and guide follow.",
      DRAPE_MEMBER(estimate.guide_harmonics));
  add("estimate", "max_solves", "", at_least(1),
      "Forward solves of one fit a picture at most, over all that is tried.",
      DRAPE_MEMBER(estimate.max_solves));
  add("estimate", "max_restarts", "", {0, 10000, true},
      "Fits from other first parameters that are tried where a misfit of twice the noise remains.",
      DRAPE_MEMBER(estimate.max_restarts));
  add("estimate", "max_moves", "", {0, 10000, true},
      "Moves to neighbouring branches that are tried where one still remains.",
      DRAPE_MEMBER(estimate.max_moves));
  add("estimate", "max_pops", "", {0, 1'000'000, true},
      "Single vertices of the mesh that are popped through where not even those explain the "
      "outline.",
      DRAPE_MEMBER(estimate.max_pops));

  add("photograph", "files", "", kAny,
      "PNG or JPEG with one silhouette each, seen from above: pictures of one fabric's specimens, "
      "fitted together.",
      DRAPE_MEMBER(photograph.files));
  add("photograph", "mm_per_pixel", "mm", kNotNegative,
      "Size of a pixel in the plane of the drape; must be given for a photograph.",
      DRAPE_MEMBER(photograph.mm_per_pixel));
  add("photograph", "areal_density", "kg/m^2", kNotNegative,
      "The fabric's mass per area; must be given for a photograph.",
      DRAPE_MEMBER(photograph.areal_density));
  add("photograph", "structure", "", kAny, "How the cloth is made, for the first parameters.",
      DRAPE_MEMBER(photograph.structure));
  add("photograph", "type", "", kAny,
      "Type of the fabric as its tag says it, as Jersey, for photograph.prior = \"tag\"; "
      "\"\" for none. It says how the cloth is made, too.",
      DRAPE_MEMBER(photograph.type));
  add("photograph", "composition", "", kAny, "Its fibres likewise, as \"Cotton 59, Modal 41\".",
      DRAPE_MEMBER(photograph.composition));
  add("photograph", "outline_noise", "m", kPositive,
      "Standard deviation of an observed radius, model error included.",
      DRAPE_MEMBER(photograph.outline_noise));
  add("photograph", "warp_angles", "deg", {-360, 360, true},
      "Direction of the warp in the pictures, counter-clockwise from their right. Several: not "
      "known, each is a start and the best posterior is kept; 180 more is the same.",
      DRAPE_MEMBER(photograph.warp_angles));
  add("photograph", "warp_angle_sd", "deg", {0, 90, true},
      "Standard deviation of the true direction about it; 0 where it is known.",
      DRAPE_MEMBER(photograph.warp_angle_sd));
  add("photograph", "scale_log_sd", "", {0, 1, true},
      "Relative standard deviation of mm_per_pixel, picture by picture; 0 where it is known.",
      DRAPE_MEMBER(photograph.scale_log_sd));
  add("photograph", "prior", "", kAny, "As estimate.prior; the start comes from the weight.",
      DRAPE_MEMBER(photograph.prior));

  add("photograph", "specimen_radius_mm", "mm", kPositive,
      "Radius of the specimen in each file, or one for all; [] for scene.specimen_radius.",
      DRAPE_MEMBER(photograph.specimen_radius_mm));
  add("photograph", "camera_height_mm", "mm", kNotNegative,
      "Height of a pinhole camera over the middle of the support, where mm_per_pixel holds; 0 for "
      "an orthographic view. Drape coefficients of photographs stay as seen.",
      DRAPE_MEMBER(photograph.camera_height_mm));

  add("photograph_set", "manifest", "", kAny,
      "CSV of photographs: columns id, file, mm_per_pixel, areal_density_gsm, and if known "
      "specimen_radius_mm, warp_angle_deg, type, composition_percent. Lines of one id are pictures "
      "of one fabric; with a type the prior is its tag's. All else is as in [photograph].",
      DRAPE_MEMBER(photograph_set.manifest));

  add("photographs", "folder", "", kAny,
      "Folder with fabric_NN/specimen_SS_capture_C.jpg; skipped, saying so, where it is missing. "
      "Scale, noise, warp and prior are those of [photograph].",
      DRAPE_MEMBER(photographs.folder));
  add("photographs", "fabrics", "", kNotNegative, "Numbers of the fabrics; [] for all.",
      DRAPE_MEMBER(photographs.fabrics));
  add("photographs", "captures", "", at_least(1),
      "How many pictures of each fabric are fitted: the first, then others of another placement, "
      "face and specimen.",
      DRAPE_MEMBER(photographs.captures));
  add("photographs", "models", "", kAny,
      "How the threshold of bending is read, and whether the softening past it is estimated too.",
      DRAPE_MEMBER(photographs.models));
  add("photographs", "weighed", "", kNotNegative, "Numbers of the fabrics of known density.",
      DRAPE_MEMBER(photographs.weighed));
  add("photographs", "densities", "kg/m^2", kPositive, "Their mass per area.",
      DRAPE_MEMBER(photographs.densities));
  add("photographs", "areal_density", "kg/m^2", kPositive,
      "Mass per area taken for the others: a drape shows stiffness over weight only.",
      DRAPE_MEMBER(photographs.areal_density));
  add("photographs", "lobes", "", {1, 60, true},
      "Lobes of the folded starts that predict drapes without a picture.",
      DRAPE_MEMBER(photographs.lobes));

  add("tag_comparison", "training", "", at_least(20),
      "Number of fabrics that the regressions learn from.", DRAPE_MEMBER(tag_comparison.training));
  add("tag_comparison", "held_out", "", at_least(1),
      "Number of other fabrics that all are compared on.", DRAPE_MEMBER(tag_comparison.held_out));

  add("identifiability", "fabrics", "", at_least(1),
      "Number of random fabrics of the measured distribution.",
      DRAPE_MEMBER(identifiability.fabrics));

  add("gradient_check", "fabrics", "", at_least(1), "Number of random fabrics.",
      DRAPE_MEMBER(gradient_check.fabrics));
  add("gradient_check", "loss", "", kAny, "The loss whose gradient is checked.",
      DRAPE_MEMBER(gradient_check.loss));
  add("gradient_check", "parameters", "", kAny, "The parameters whose derivatives are checked.",
      DRAPE_MEMBER(gradient_check.parameters));
  add("gradient_check", "steps", "", {0, 0.1, false},
      "Steps of the central differences, of log parameters (of t_b itself).",
      DRAPE_MEMBER(gradient_check.steps));

  add("robustness", "fabrics", "", at_least(1),
      "Number of random fabrics: half of the measured distribution, half from a wide box.",
      DRAPE_MEMBER(robustness.fabrics));
  add("robustness", "vertices", "", kVertices,
      "Mesh sizes to solve them on. The first one's results.h5 is the run's, the others' are in "
      "vertices_N.",
      DRAPE_MEMBER(robustness.vertices));
  add("robustness", "only", "", kNotNegative,
      "Indices of the fabrics to solve (again), e.g. of a failure; [] for all.",
      DRAPE_MEMBER(robustness.only));

  add("paper", "configs", "", kAny, "The experiments whose figures are collected, in this order.",
      DRAPE_MEMBER(paper.configs));

  add("quickstart", "fabrics", "", at_least(1), "Number of fabrics, from the top of the table.",
      DRAPE_MEMBER(quickstart.fabrics));
  add("quickstart", "table", "", kAny,
      "CSV of tags, columns as in dataset.table; must be given for the quickstart.",
      DRAPE_MEMBER(quickstart.table));
  add("quickstart", "photograph", "", kAny,
      "A photograph to fit as well; \"\" for none. Skipped, saying so, where it is missing.",
      DRAPE_MEMBER(quickstart.photograph));
  add("quickstart", "mm_per_pixel", "mm", kNotNegative, "Size of a pixel of the photograph.",
      DRAPE_MEMBER(quickstart.mm_per_pixel));
  add("quickstart", "areal_density", "kg/m^2", kNotNegative,
      "Mass per area of the fabric in the photograph.", DRAPE_MEMBER(quickstart.areal_density));

  add("validation", "slenderness", "", kPositive,
      "Lengths of the cantilever strips over (B / weight per area)^(1/3).",
      DRAPE_MEMBER(validation.slenderness));
  add("validation", "edge_lengths", "m", kPositive, "Edge lengths of the strips' meshes.",
      DRAPE_MEMBER(validation.edge_lengths));
  add("validation", "widths", "m", kPositive, "Widths of the strips.",
      DRAPE_MEMBER(validation.widths));
  add("validation", "plate_vertices", "", kVertices, "Mesh sizes of the annular plate.",
      DRAPE_MEMBER(validation.plate_vertices));
  add("validation", "seeds", "", at_least(1), "Meshes of every size.",
      DRAPE_MEMBER(validation.seeds));
  add("validation", "bias_vertices", "", kVertices, "Mesh sizes of the drapes on turned meshes.",
      DRAPE_MEMBER(validation.bias_vertices));
  add("validation", "rotations", "", at_least(1), "Rotations of every mesh, over half a turn.",
      DRAPE_MEMBER(validation.rotations));

  add("accuracy", "vertices", "", kVertices, "Mesh sizes.", DRAPE_MEMBER(accuracy.vertices));
  add("accuracy", "reference_vertices", "", kVertices, "Mesh size of the reference drapes.",
      DRAPE_MEMBER(accuracy.reference_vertices));
  add("accuracy", "seeds", "", at_least(1), "Meshes of every size.", DRAPE_MEMBER(accuracy.seeds));
  add("accuracy", "fabrics", "", {1, 9, true}, "How many of the study's nine fabrics.",
      DRAPE_MEMBER(accuracy.fabrics));

  add("work_precision", "vertices", "", kVertices, "Mesh sizes.",
      DRAPE_MEMBER(work_precision.vertices));
  add("work_precision", "seeds", "", at_least(1), "Meshes of every size.",
      DRAPE_MEMBER(work_precision.seeds));
  add("work_precision", "fabrics", "", {1, 9, true},
      "How many of the study's nine fabrics; the first three are a stiff, a medium and a soft one.",
      DRAPE_MEMBER(work_precision.fabrics));
  add("work_precision", "methods", "", kAny, "The methods to compare; [] for all.",
      DRAPE_MEMBER(work_precision.methods));
  add("work_precision", "cpu_seconds", "s", kPositive,
      "CPU time of each run on 1000 vertices; on other meshes in proportion to their vertices.",
      DRAPE_MEMBER(work_precision.cpu_seconds));

  add("stability", "vertices", "", kVertices, "Mesh sizes.", DRAPE_MEMBER(stability.vertices));
  add("stability", "membrane_to_bending", "", kPositive,
      "Stretch stiffness times the overhang's square over the flexural rigidity; the membrane "
      "changes, the bending stays.",
      DRAPE_MEMBER(stability.membrane_to_bending));
  add("stability", "areal_density", "kg/m^2", kPositive, "Masses per area.",
      DRAPE_MEMBER(stability.areal_density));
  add("stability", "time_steps", "s", kPositive,
      "Time steps of the methods that have one, besides the step that each chooses itself.",
      DRAPE_MEMBER(stability.time_steps));
  add("stability", "methods", "", kAny, "The methods to try; [] for all.",
      DRAPE_MEMBER(stability.methods));
  add("stability", "cpu_seconds", "s", kPositive,
      "CPU time of each run on 1000 vertices; on other meshes in proportion to their vertices.",
      DRAPE_MEMBER(stability.cpu_seconds));
  add("stability", "only", "", kNotNegative,
      "Indices of the cells to run (again), e.g. of a failure; [] for all.",
      DRAPE_MEMBER(stability.only));

  add("ablation", "drape_coefficients", "per cent", {0, 100, true},
      "Fabrics: the given one with its bending stiffnesses scaled to these drape coefficients.",
      DRAPE_MEMBER(ablation.drape_coefficients));
  add("ablation", "ingredients", "", kAny, "What is changed, one at a time; [] for all.",
      DRAPE_MEMBER(ablation.ingredients));
  add("ablation", "outline_tolerance", "m", kPositive,
      "The rule of contact = \"auto\" has to act where contact changes the outline by more (rms), "
      "or "
      "the drape coefficient by more than mesh.tolerance.",
      DRAPE_MEMBER(ablation.outline_tolerance));
  add("ablation", "largest_vertices", "", kNotNegative,
      "Largest mesh on which the rule of vertices = \"auto\" is tried, at least 600; it is judged "
      "on "
      "one twice as large. 0 leaves that out.",
      DRAPE_MEMBER(ablation.largest_vertices));

  add("gradient_precision", "parameters", "", kAny, "The parameters of the gradient.",
      DRAPE_MEMBER(gradient_precision.parameters));
  add("gradient_precision", "tolerances", "", {0, 1, false},
      "Relative residuals at which adjoint and sensitivities are tried.",
      DRAPE_MEMBER(gradient_precision.tolerances));
  add("gradient_precision", "steps", "", {0, 1, false},
      "Steps of the central differences, of log parameters.",
      DRAPE_MEMBER(gradient_precision.steps));
  add("gradient_precision", "difference_tolerances", "", {0, 1, false},
      "Relative residuals of the equilibria that are differenced.",
      DRAPE_MEMBER(gradient_precision.difference_tolerances));
  add("gradient_precision", "time_steps", "s", kPositive, "Of the unrolled dynamics.",
      DRAPE_MEMBER(gradient_precision.time_steps));
  add("gradient_precision", "unrolled_steps", "", at_least(1),
      "Numbers of time steps after which the dynamics are truncated, ascending.",
      DRAPE_MEMBER(gradient_precision.unrolled_steps));
  add("gradient_precision", "snap_to", "", {1, kInfinity, false},
      "A snap is looked for from the fabric's bending stiffness to this many times it.",
      DRAPE_MEMBER(gradient_precision.snap_to));
  add("gradient_precision", "distances", "", {0, 1, false},
      "Distances from the limit point at which the gradient is looked at, of the log stiffness.",
      DRAPE_MEMBER(gradient_precision.distances));

  add("estimation_precision", "fabrics", "", at_least(1),
      "Number of random fabrics; distribution, drape_coefficient, anisotropy, protocols, "
      "parameters "
      "and the wrongness of the starts are those of [estimate].",
      DRAPE_MEMBER(estimation_precision.fabrics));
  add("estimation_precision", "starts", "", at_least(1), "First parameters tried for each fabric.",
      DRAPE_MEMBER(estimation_precision.starts));
  add("estimation_precision", "methods", "", kAny, "The methods to compare; [] for all.",
      DRAPE_MEMBER(estimation_precision.methods));
  add("estimation_precision", "cpu_seconds", "s", kPositive,
      "CPU time of each fit on 1000 vertices; on other meshes in proportion to their vertices.",
      DRAPE_MEMBER(estimation_precision.cpu_seconds));

  add("branches", "softest", "", kPositive,
      "Factor on the fabric's bending stiffnesses where the sweeps start and end.",
      DRAPE_MEMBER(branches.softest));
  add("branches", "stiffest", "", kPositive, "Factor where they turn back; more than softest.",
      DRAPE_MEMBER(branches.stiffest));
  add("branches", "ramp", "", kAny, "Follow the branch that the gravity ramp finds.",
      DRAPE_MEMBER(branches.ramp));
  add("branches", "lobes", "", {1, 60, true},
      "Follow the branches that starts folded into these many lobes find.",
      DRAPE_MEMBER(branches.lobes));
  add("branches", "largest_step", "", {0, 1, false},
      "Of the logarithm of the stiffness, in one step.", DRAPE_MEMBER(branches.largest_step));
}

}  // namespace drape
