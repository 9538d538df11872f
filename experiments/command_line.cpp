#include "experiments/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string_view>

#include "core/version.h"
#include "experiments/config_text.h"
#include "experiments/spelling.h"

namespace drape {
namespace {

// What is misspelt among the words of a command line that CLI11 refused; empty if nothing is.
std::string misspelt(CLI::App& app, const std::vector<std::string>& words) {
  const auto is_option = [](const std::string& word) { return word.starts_with("-"); };
  const auto suggestion = [](const std::string& what, const std::string& word,
                             const std::vector<std::string>& known) {
    const auto near = nearest(word, known);
    return "unknown " + what + " '" + word + "'" + (near ? "; did you mean '" + *near + "'?" : "");
  };

  CLI::App* active = &app;
  for (auto word = words.begin(); word != words.end(); ++word) {
    const auto subcommands = active->get_subcommands(
        [](CLI::App* of) { return !of->get_name().empty(); });  // groups of options have none
    if (subcommands.empty() || is_option(*word)) continue;
    std::vector<std::string> commands;
    CLI::App* next = nullptr;
    for (CLI::App* candidate : subcommands) {
      commands.push_back(candidate->get_name());
      if (candidate->get_name() == *word) next = candidate;
    }
    if (next == nullptr) return suggestion("command", *word, commands);
    active = next;
  }

  std::vector<std::string> options;
  for (const CLI::Option* option : active->get_options())
    for (const std::string& long_name : option->get_lnames()) options.push_back("--" + long_name);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const std::string option = word.substr(0, word.find('='));
    if (std::find(options.begin(), options.end(), option) == options.end())
      return suggestion("option", option, options);
  }
  return {};
}

/// The commands `dataset ...`; what is parsed goes into `command`.
void add_dataset_commands(CLI::App& app, DatasetCommand& command) {
  CLI::App* dataset = app.add_subcommand("dataset", "Work on tables of records");
  dataset->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, DatasetAction action) {
    CLI::App* sub = dataset->add_subcommand(name, help);
    sub->callback([&command, action] { command.action = action; });
    return sub;
  };
  const auto add_file = [&](CLI::App* sub) {
    sub->add_option_function<std::string>(
           "FILE", [&command](const std::string& file) { command.files = {file}; },
           "Records in HDF5")
        ->type_name("")
        ->required();
  };
  CLI::App* merge = add("merge", "Put the shards of a set together", DatasetAction::merge);
  merge->add_option("OUT", command.out, "New file")->type_name("")->required();
  merge->add_option("SHARDS", command.files, "The results.h5 of all shards")
      ->type_name("")
      ->required();
  merge->add_flag("--virtual", command.virtual_view, "Show the shards instead of copying them");

  CLI::App* verify =
      add("verify", "Check a table and compute some of it again", DatasetAction::verify);
  add_file(verify);
  verify->add_option("--sample", command.sample, "How many drapes to compute again")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();

  CLI::App* migrate =
      add("migrate", "Write a table of an older schema in the current one", DatasetAction::migrate);
  add_file(migrate);
  migrate->add_option("OUT", command.out, "New file")->type_name("")->required();

  CLI::App* exported = dataset->add_subcommand("export", "Write records in another format");
  add_file(exported);
  CLI::Option_group* formats = exported->add_option_group("formats");
  formats->require_option(1);
  const auto add_format = [&](const char* name, const char* help, DatasetAction action) {
    formats
        ->add_option_function<std::string>(
            name,
            [&command, action](const std::string& out) {
              command.action = action;
              command.out = out;
            },
            help)
        ->type_name("OUT");
  };
  add_format("--csv", "Tags, parameters and what is seen, a line each", DatasetAction::export_csv);
  add_format("--obj", "The drape of a record", DatasetAction::export_obj);
  add_format("--vtu", "The drape of a record, for ParaView", DatasetAction::export_vtu);
  exported->add_option("--record", command.record, "Which record, from 0")
      ->type_name("I")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

/// --shard K/N as two numbers; throws UsageError.
std::pair<std::string, std::string> shard_numbers(const std::string& text) {
  const size_t slash = text.find('/');
  const auto is_number = [](const std::string& part) {
    return !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
  };
  if (slash == std::string::npos || !is_number(text.substr(0, slash)) ||
      !is_number(text.substr(slash + 1)))
    throw UsageError("--shard " + text + ": expected K/N with K from 1 to N, such as 2/8");
  return {text.substr(0, slash), text.substr(slash + 1)};
}

std::string list_text(const std::vector<std::string>& entries) {
  std::string text = "[";
  for (const std::string& entry : entries) text += (text.size() > 1 ? ", " : "") + entry;
  return text + "]";
}

}  // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  std::string file, out, threads, query, mm_per_pixel, density, warp_angle, camera_height, dataset,
      type, composition, manifest, shard;
  std::vector<std::string> sets, records, photos, radii;

  CLI::App app("Drape: fabric parameters in, drapes out; silhouettes in, fabric parameters out.",
               "drape");
  app.set_version_flag("--version", "drape " + std::string(version()) + " (commit " +
                                        std::string(git_commit()) + ", " + std::string(compiler()) +
                                        ")");
  app.require_subcommand(1);
  const auto with_settings = [&](CLI::App* command) {
    command->add_option("--set", sets, "Override a key of the config: section.key=value")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
  };
  const auto with_run = [&](CLI::App* command) {
    with_settings(command);
    command->add_option("--out", out, "Folder of the results; an unfinished run in it is resumed")
        ->type_name("DIR")
        ->required();
    command->add_option("--threads", threads, "Number of threads; 0 means all")->type_name("N");
  };

  CLI::App* run = app.add_subcommand("run", "Run the experiment of a config");
  run->add_option("CONFIG", file, "Config in TOML")->type_name("")->required();
  with_run(run);
  run->add_option("--shard", shard, "Drape the K-th of N parts of a dataset alone")
      ->type_name("K/N");

  CLI::App* validate = app.add_subcommand("validate", "Check a config without running it");
  validate->add_option("CONFIG", file, "Config in TOML")->type_name("")->required();
  with_settings(validate);

  CLI::App* explain = app.add_subcommand("explain", "Explain the keys of configs");
  explain->add_option("KEY", query, "section.key, key or section; all without")->type_name("");

  CLI::App* info = app.add_subcommand("info", "Show what is inside a results.h5");
  info->add_option("FILE", file, "Records in HDF5")->type_name("")->required();

  CLI::App* estimate = app.add_subcommand(
      "estimate", "Estimate parameters from photographs, a dataset, or as a config says");
  estimate->add_option("CONFIG", file, "Config in TOML for what no option says")->type_name("");
  CLI::Option* photo_option =
      estimate
          ->add_option("--photo", photos, "PNG or JPEG with one silhouette; several of one fabric")
          ->type_name("FILE");
  estimate->add_option("--mm-per-pixel", mm_per_pixel, "Size of a pixel")
      ->type_name("MM")
      ->needs(photo_option);
  estimate->add_option("--density", density, "Mass per area of the fabric, kg/m^2")
      ->type_name("D")
      ->needs(photo_option);
  estimate
      ->add_option("--warp-angle", warp_angle,
                   "Direction of the warp, degrees counter-clockwise from the right; without it "
                   "several are tried")
      ->type_name("DEG")
      ->needs(photo_option);
  estimate
      ->add_option("--specimen-radius-mm", radii,
                   "Radius of the specimen in each photograph, or one for all")
      ->type_name("MM")
      ->needs(photo_option);
  estimate
      ->add_option("--camera-height-mm", camera_height,
                   "Height of the camera over the support; without it the view is orthographic")
      ->type_name("MM")
      ->needs(photo_option);
  CLI::Option* type_option =
      estimate
          ->add_option("--type", type, "Type of the fabric on its tag, as Jersey; the prior is its")
          ->type_name("NAME")
          ->needs(photo_option);
  CLI::Option* composition_option =
      estimate->add_option("--composition", composition, "As \"Cotton 59, Modal 41\"")
          ->type_name("FIBRES")
          ->needs(type_option);
  type_option->needs(composition_option);
  CLI::Option* manifest_option =
      estimate
          ->add_option("--manifest", manifest,
                       "A table of photographs of many fabrics; see explain")
          ->type_name("FILE")
          ->excludes(photo_option);
  CLI::Option* dataset_option =
      estimate->add_option("--dataset", dataset, "A results.h5 with observations")
          ->type_name("FILE")
          ->excludes(photo_option)
          ->excludes(manifest_option);
  estimate->add_option("--records", records, "Indices of its records, as 0,3,4; all without")
      ->type_name("I")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs(dataset_option);
  with_run(estimate);

  add_dataset_commands(app, line.dataset);

  CLI::App* tag = app.add_subcommand("tag", "Tell what a fabric's tag says of its parameters");
  tag->add_option("--type", line.tag.type, "As Jersey or Denim")->type_name("NAME")->required();
  tag->add_option("--composition", line.tag.composition, "As \"Cotton 59, Modal 40\"")
      ->type_name("FIBRES")
      ->required();
  tag->add_option("--density", line.tag.density, "Mass per area, kg/m^2")
      ->type_name("D")
      ->required();
  tag->add_option("--dataset", line.tag.dataset,
                  "A results.h5 of fabrics with tags to learn from; without it the tag model")
      ->type_name("FILE");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    app.exit(request, std::cout, std::cerr);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const std::string wrong = misspelt(app, std::vector<std::string>(argv + 1, argv + argc));
    throw UsageError((wrong.empty() ? error.what() : wrong) + "\nMore with --help.");
  }

  line.command = *run        ? Command::run
                 : *validate ? Command::validate
                 : *explain  ? Command::explain
                 : *info     ? Command::info
                 : *estimate ? Command::estimate
                 : *tag      ? Command::tag
                             : Command::dataset;
  if (!file.empty()) line.file = file;
  line.out = out;
  line.query = query;
  if (line.command == Command::estimate && file.empty() && photos.empty() && manifest.empty() &&
      dataset.empty())
    throw UsageError(
        "estimate needs --photo FILE, --manifest FILE, --dataset FILE or a CONFIG\n"
        "More with --help.");

  // The values go through the same checks as those of a file. What --set says comes last.
  const auto assign = [&](const char* key, const std::string& value, const std::string& origin) {
    if (!value.empty()) line.assignments.push_back({key, value, origin + " " + value});
  };
  if (!photos.empty()) {
    assign("experiment.kind", "photograph", "--photo");
    line.assignments.push_back({"photograph.files", format_value(photos), "--photo"});
  }
  if (!manifest.empty()) {
    assign("experiment.kind", "photograph_set", "--manifest");
    assign("photograph_set.manifest", manifest, "--manifest");
  }
  if (!type.empty()) {
    assign("photograph.prior", "tag", "--type");
    assign("photograph.type", type, "--type");
    assign("photograph.composition", composition, "--composition");
  }
  if (!dataset.empty()) assign("experiment.kind", "estimate", "--dataset");
  assign("photograph.mm_per_pixel", mm_per_pixel, "--mm-per-pixel");
  assign("photograph.areal_density", density, "--density");
  if (!radii.empty())
    line.assignments.push_back(
        {"photograph.specimen_radius_mm", list_text(radii), "--specimen-radius-mm"});
  assign("photograph.camera_height_mm", camera_height, "--camera-height-mm");
  if (!warp_angle.empty()) {
    assign("photograph.warp_angles", "[" + warp_angle + "]", "--warp-angle");
    assign("photograph.warp_angle_sd", "0", "--warp-angle");
  }
  assign("estimate.dataset", dataset, "--dataset");
  if (!records.empty()) assign("estimate.records", list_text(records), "--records");
  assign("experiment.threads", threads, "--threads");
  if (!shard.empty()) {
    const auto [number, count] = shard_numbers(shard);
    line.assignments.push_back({"dataset.shard", number, "--shard " + shard});
    line.assignments.push_back({"dataset.shards", count, "--shard " + shard});
  }
  for (const std::string& text : sets) line.assignments.push_back(assignment_from_set(text));
  return line;
}

}  // namespace drape
