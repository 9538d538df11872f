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
  const auto command = std::find_if_not(words.begin(), words.end(), is_option);
  const auto suggestion = [](const std::string& what, const std::string& word,
                             const std::vector<std::string>& known) {
    const auto near = nearest(word, known);
    return "unknown " + what + " '" + word + "'" + (near ? "; did you mean '" + *near + "'?" : "");
  };

  const CLI::App* active = &app;
  if (command != words.end()) {
    std::vector<std::string> commands;
    for (const CLI::App* candidate : app.get_subcommands([](CLI::App*) { return true; })) {
      commands.push_back(candidate->get_name());
      if (candidate->get_name() == *command) active = candidate;
    }
    if (active == &app) return suggestion("command", *command, commands);
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

std::string list_text(const std::vector<std::string>& entries) {
  std::string text = "[";
  for (const std::string& entry : entries) text += (text.size() > 1 ? ", " : "") + entry;
  return text + "]";
}

}  // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv) {
  std::string file, out, threads, query, mm_per_pixel, density, warp_angle, dataset;
  std::vector<std::string> sets, records, photos;

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
  CLI::Option* dataset_option =
      estimate->add_option("--dataset", dataset, "A results.h5 with observations")
          ->type_name("FILE")
          ->excludes(photo_option);
  estimate->add_option("--records", records, "Indices of its records, as 0,3,4; all without")
      ->type_name("I")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs(dataset_option);
  with_run(estimate);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    app.exit(request, std::cout, std::cerr);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const std::string wrong = misspelt(app, std::vector<std::string>(argv + 1, argv + argc));
    throw UsageError((wrong.empty() ? error.what() : wrong) + "\nMore with --help.");
  }

  CommandLine line;
  line.command = *run        ? Command::run
                 : *validate ? Command::validate
                 : *explain  ? Command::explain
                 : *info     ? Command::info
                             : Command::estimate;
  if (!file.empty()) line.file = file;
  line.out = out;
  line.query = query;
  if (line.command == Command::estimate && file.empty() && photos.empty() && dataset.empty())
    throw UsageError("estimate needs --photo FILE, --dataset FILE or a CONFIG\nMore with --help.");

  // The values go through the same checks as those of a file. What --set says comes last.
  const auto assign = [&](const char* key, const std::string& value, const std::string& origin) {
    if (!value.empty()) line.assignments.push_back({key, value, origin + " " + value});
  };
  if (!photos.empty()) {
    assign("experiment.kind", "photograph", "--photo");
    line.assignments.push_back({"photograph.files", format_value(photos), "--photo"});
  }
  if (!dataset.empty()) assign("experiment.kind", "estimate", "--dataset");
  assign("photograph.mm_per_pixel", mm_per_pixel, "--mm-per-pixel");
  assign("photograph.areal_density", density, "--density");
  if (!warp_angle.empty()) {
    assign("photograph.warp_angles", "[" + warp_angle + "]", "--warp-angle");
    assign("photograph.warp_angle_sd", "0", "--warp-angle");
  }
  assign("estimate.dataset", dataset, "--dataset");
  if (!records.empty()) assign("estimate.records", list_text(records), "--records");
  assign("experiment.threads", threads, "--threads");
  for (const std::string& text : sets) line.assignments.push_back(assignment_from_set(text));
  return line;
}

}  // namespace drape
