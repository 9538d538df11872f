#include "experiments/paper_parts.h"

#include <stdexcept>

#include "experiments/config.h"

namespace drape {

std::vector<PaperPart> paper_parts(const Settings& settings) {
  std::vector<PaperPart> parts;
  for (const std::filesystem::path& config : settings.paper.configs) {
    PaperPart part{config.stem().string(), config, read_settings(config)};
    part.settings.experiment.threads = settings.experiment.threads;
    if (part.settings.experiment.kind == Kind::paper)
      throw std::invalid_argument(config.string() + ": a paper cannot hold another");
    for (const PaperPart& other : parts)
      if (other.name == part.name)
        throw std::invalid_argument("paper.configs: two configs are named " + part.name);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace drape
