#include "experiments/ablation_subjects.h"

#include <filesystem>
#include <sstream>

#include "core/durable_file.h"
#include "experiments/ablation.h"
#include "experiments/start_outline.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillimetre = 1e-3;

void write_outline(const std::filesystem::path& file, const Json& corners_mm) {
  std::ostringstream text;
  text.precision(9);
  text << "x,y\n";
  for (size_t i = 0; i + 1 < corners_mm.size(); i += 2)
    text << kMillimetre * corners_mm[i].get<double>() << ","
         << kMillimetre * corners_mm[i + 1].get<double>() << "\n";
  std::filesystem::create_directories(file.parent_path());
  write_text_durably(file, text.str());
}

}  // namespace

std::vector<AblationSubject> ablation_subjects(const Settings& settings) {
  std::vector<AblationSubject> subjects;
  for (const double percent : settings.ablation.drape_coefficients)
    subjects.push_back({std::to_string(subjects.size()), percent, std::nullopt});
  const std::filesystem::path& photographs = settings.photographs.folder;
  if (!photographs.empty() && std::filesystem::is_directory(photographs))
    for (const FabricCaptures& fabric : captures_by_fabric(settings))
      for (const Capture& capture : fabric.chosen) subjects.push_back({capture.name(), 0, capture});
  return subjects;
}

Json find_fabric(const Settings& settings, const AblationSubject& subject,
                 std::shared_ptr<const Discretization> fine,
                 const std::shared_ptr<const Discretization>& coarse) {
  Json about;
  if (!subject.capture) {
    about["aim"] = subject.drape_coefficient;
    const Fabric fabric = fabric_of_coefficient(settings, coarse, subject.drape_coefficient);
    for (const Parameter p : all_parameters())
      about["parameters"][std::string(name(p))] = fabric[p];
    return about;
  }
  const Json fit = fit_capture(settings, std::move(fine), *subject.capture);
  about["capture"] = subject.name;
  for (const char* key : {"outcome", "free", "outline_rms_mm", "parameters"}) about[key] = fit[key];
  about["outline_mm"] = Json::array();
  const Points2 outline = outline_on_fabric(settings, *subject.capture, fit);
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
    for (const double x : {outline(i, 0), outline(i, 1)})
      about["outline_mm"].push_back(x / kMillimetre);
  return about;
}

SubjectSettings settings_of(const Settings& settings, const AblationSubject& subject,
                            const Json& about, const OutputFolder& folder) {
  SubjectSettings own{settings, {}};
  own.settings.fabric = fitted_fabric(about);
  if (!subject.capture) return own;
  own.settings.start.protocol = StartProtocol::guided;
  own.settings.start.outline = folder / "outlines" / (subject.name + ".csv");
  write_outline(own.settings.start.outline, about["outline_mm"]);
  own.observed = start_profile(own.settings);
  return own;
}

}  // namespace drape
