// The experiments that a paper consists of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/settings.h"

namespace drape {

struct PaperPart {
  std::string name;  ///< of its folder: that of its config
  std::filesystem::path config;
  Settings settings;
};

/// The parts in order, with the paper's number of threads. Throws like read_settings, and
/// std::invalid_argument where two have one name or one is a paper itself.
std::vector<PaperPart> paper_parts(const Settings& settings);

}  // namespace drape
