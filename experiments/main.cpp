// The program: from a command line to a finished folder and an exit code.
//
// Exit codes: 0 done; 1 unexpected error; 2 wrong use, bad config or bad input; 3 done, but at
// least one solve failed; 130 interrupted, with everything acknowledged kept.
#include <chrono>
#include <exception>
#include <iostream>
#include <set>
#include <stdexcept>

#include "core/records.h"
#include "estimation/photograph.h"
#include "experiments/command_line.h"
#include "experiments/config_keys.h"
#include "experiments/config_text.h"
#include "experiments/dataset_fabrics.h"
#include "experiments/interrupt.h"
#include "experiments/isolated.h"
#include "experiments/paper_parts.h"
#include "experiments/photograph_fit.h"
#include "experiments/run_kind.h"
#include "experiments/start_outline.h"
#include "experiments/summary.h"
#include "experiments/tag_dataset.h"
#include "experiments/tag_report.h"

namespace drape {
namespace {

constexpr int kDone = 0, kUnexpected = 1, kBadInput = 2, kSolveFailed = 3, kInterrupted = 130;

int exit_code(const std::string& status) { return status == "ok" ? kDone : kSolveFailed; }

void print_content(const OutputFolder& folder) {
  std::set<std::filesystem::path> visible;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (!entry.path().filename().string().starts_with('.')) visible.insert(entry.path());
  for (const std::filesystem::path& path : visible) std::cout << "  " << path.string() << "\n";
}

/// Reads a table in a child process first.
void probe_records(const std::filesystem::path& file) {
  probe(file.string(), [&file] { visit_records(file, [](size_t, const Record&) {}); });
}

/// What is said of a photographed fabric, and its pictures.
void check_photographs(const Settings& settings) {
  tag_of(settings.photograph);
  for (size_t i = 0; i < settings.photograph.files.size(); ++i) {
    const Scene scene = with_specimen(settings, i).scene;
    validate(scene);
    read_photograph(settings.photograph.files[i], 1e-3 * settings.photograph.mm_per_pixel, scene);
  }
}

/// Reads the input files of a run before anything is written: throws what the run itself would.
void check_inputs(const Settings& settings) {
  const Kind kind = settings.experiment.kind;
  if (!settings.estimate.tag_dataset.empty()) {
    probe_records(settings.estimate.tag_dataset);
    tag_regression(settings.estimate.tag_dataset);
  }
  if (settings.start.protocol == StartProtocol::guided) start_profile(settings);
  if (kind == Kind::photograph) {
    check_photographs(settings);
  } else if (kind == Kind::photograph_set) {
    const std::filesystem::path& manifest = settings.photograph_set.manifest;
    for (const PhotographedFabric& fabric : read_photograph_manifest(manifest)) try {
        check_photographs(with_photographs(settings, fabric));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(manifest.string() + ": fabric '" + fabric.id +
                                    "': " + error.what());
      }
  } else if (kind == Kind::paper) {
    paper_parts(settings);
  } else if (kind == Kind::estimate && !settings.estimate.dataset.empty()) {
    const std::filesystem::path& file = settings.estimate.dataset;
    probe_records(file);
    read_header(file);
  } else if (kind == Kind::dataset &&
             !(settings.dataset.table.empty() && settings.dataset.parameters.empty())) {
    DatasetFabrics(settings).chosen();
  }
}

int run(const Settings& settings, const std::filesystem::path& out) {
  check_inputs(settings);
  const RunStart start;
  OutputFolder folder(out, settings);
  if (folder.state() == OutputFolder::State::finished) {
    const std::string status = read_status(folder);
    std::cout << "Already done, nothing to do (status " << status << "):\n";
    print_content(folder);
    return exit_code(status);
  }
  if (folder.state() == OutputFolder::State::resumed)
    std::cerr << "Resuming the run in " << out.string() << "\n";

  catch_interrupts();
  const RunOutcome outcome = run_kind(settings, folder);
  if (interrupted()) {
    std::cerr << "Interrupted. " << out.string()
              << " keeps what was finished; the same command resumes it.\n";
    return kInterrupted;
  }
  write_summary(folder, summary(settings.experiment.kind, outcome, start));
  std::cout << "Done (status " << outcome.status << "):\n";
  print_content(folder);
  return exit_code(outcome.status);
}

int execute(const CommandLine& line) {
  switch (line.command) {
    case Command::run:
      return run(read_settings(line.file, line.assignments), line.out);
    case Command::estimate: {
      const Settings settings = read_settings(line.file, line.assignments);
      const Kind kind = settings.experiment.kind;
      if (kind != Kind::estimate && kind != Kind::photograph && kind != Kind::photograph_set)
        throw UsageError(
            "estimate needs a config of kind \"estimate\", \"photograph\" or \"photograph_set\", "
            "not \"" +
            name(kind) + "\"; use drape run");
      return run(settings, line.out);
    }
    case Command::validate: {
      const Settings settings = read_settings(line.file, line.assignments);
      std::cout << line.file->string() << ": valid, kind \"" << name(settings.experiment.kind)
                << "\"\n";
      return kDone;
    }
    case Command::explain:
      std::cout << explain(line.query);
      return kDone;
    case Command::info:
      return isolated(line.file->string(), [&] {
        std::cout << describe_records(*line.file);
        return kDone;
      });
    case Command::dataset:
      return run_dataset_command(line.dataset);
    case Command::tag: {
      const Tag tag = tag_from_words(line.tag.type, line.tag.composition, line.tag.density);
      if (line.tag.dataset.empty()) {
        std::cout << tag_report(tag, BendingThreshold::radius);
        return kDone;
      }
      return isolated(line.tag.dataset.string(), [&] {
        std::cout << tag_report(tag, line.tag.dataset);
        return kDone;
      });
    }
  }
  throw std::logic_error("a command without a function");
}

int guarded_main(int argc, char** argv) {
  try {
    const std::optional<CommandLine> line = parse_command_line(argc, argv);
    return line ? execute(*line) : kDone;
  } catch (const std::invalid_argument& error) {  // UsageError and ConfigError as well
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const RecordError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "Unexpected error: " << error.what() << "\n";
    return kUnexpected;
  }
}

}  // namespace
}  // namespace drape

int main(int argc, char** argv) { return drape::guarded_main(argc, argv); }
