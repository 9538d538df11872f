// Figures are drawn by the Python scripts in experiments/figures.
#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// Runs experiments/figures/SCRIPT RESULTS --out STEM, which writes STEM.png and STEM.pdf. Throws
/// std::runtime_error with the script's last words if it fails.
void draw_figure(const std::string& script, const std::filesystem::path& results,
                 const std::filesystem::path& stem);

}  // namespace drape
