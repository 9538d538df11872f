#include "experiments/start_outline.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/outline.h"
#include "core/profile.h"
#include "core/records.h"

namespace drape {
namespace {

Points2 read_polygon(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<Vec2> corners;
  std::string line;
  const auto refuse = [&](size_t row, const std::string& message) {
    throw std::invalid_argument(file.string() + ":" + std::to_string(row) + ": " + message);
  };
  std::getline(stream, line);
  if (line != "x,y" && line != "x,y\r") refuse(1, "the first line must be x,y");
  for (size_t row = 2; std::getline(stream, line); ++row) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream text(line);
    Vec2 corner;
    char comma = 0;
    std::string rest;
    if (!(text >> corner.x() >> comma >> corner.y()) || comma != ',' || text >> rest)
      refuse(row, "must be two numbers, as 0.12,-0.03");
    corners.push_back(corner);
  }
  if (corners.size() < 3) refuse(corners.size() + 1, "an outline has three corners or more");
  Points2 polygon(static_cast<Eigen::Index>(corners.size()), 2);
  for (size_t i = 0; i < corners.size(); ++i)
    polygon.row(static_cast<Eigen::Index>(i)) = corners[i];
  return polygon;
}

VecX profile_of_polygon(const std::filesystem::path& file) {
  const Points2 polygon = read_polygon(file);
  if (!(area(polygon) > 0))
    throw std::invalid_argument(file.string() + ": the corners must go round counter-clockwise");
  try {
    return radial_profile(polygon).radius;
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument(file.string() + ": the outline must go round (0, 0)");
  }
}

VecX profile_of_record(const std::filesystem::path& file, int index) {
  const std::vector<Record> records = read_records(file);
  if (index >= static_cast<int>(records.size()))
    throw std::invalid_argument("start.record = " + std::to_string(index) + ": " + file.string() +
                                " has records 0 to " + std::to_string(records.size() - 1));
  VecX profile = records[static_cast<size_t>(index)].observation.profile;
  if (!profile.allFinite())
    throw std::invalid_argument(file.string() + ": record " + std::to_string(index) +
                                " has no drape");
  return profile;
}

}  // namespace

VecX start_profile(const Settings& settings) {
  const StartSettings& start = settings.start;
  const VecX profile = start.outline.empty() ? profile_of_record(start.dataset, start.record)
                                             : profile_of_polygon(start.outline);
  if (profile.maxCoeff() > 1.2 * settings.scene.specimen_radius ||
      profile.maxCoeff() < settings.scene.support_radius)
    throw std::invalid_argument("the outline of a guided start reaches " +
                                std::to_string(profile.maxCoeff()) +
                                " m; must lie between support and specimen radius, in metres");
  return profile;
}

}  // namespace drape
