#include "experiments/dataset_verify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <sstream>

#include "core/records.h"
#include "core/sha256.h"
#include "experiments/model.h"

namespace drape {
namespace {

/// Positions are stored as they were solved: what is computed from them again differs by the order
/// of sums on another machine only.
constexpr double kSameOutline = 1e-9;  // [m] and [1]
constexpr double kSameResidual = 1.5;  // of the stored one or the rounding floor
constexpr double kRim = 1e-3;          // what stretch may add to a radius [m]

struct Broken {
  std::string reason;
};

void require(bool holds, const std::string& reason) {
  if (!holds) throw Broken{reason};
}

void check_ranges(const Record& record, const Scene& scene) {
  const Observation& seen = record.observation;
  require(!record.id.empty(), "its id is empty");
  require(!record.stats.status.empty(), "/stats/status is empty");
  require(record.stats.cpu_seconds >= 0, "/stats/cpu_seconds is not >= 0");
  if (!converged(record)) {
    require(!record.positions.allFinite(), "not converged, but /sim/positions are there");
    return;
  }
  require(record.positions.allFinite(), "/sim/positions are not finite");
  require(seen.profile.allFinite() &&
              seen.profile.maxCoeff() <= scene.specimen_radius * 1.5 + kRim &&
              seen.profile.minCoeff() > 0,
          "/observation/profile is not between 0 and 1.5 radii of the specimen");
  require(seen.drape_coefficient > -0.1 && seen.drape_coefficient < 1.5,
          "/observation/drape_coefficient is not a fraction");
  require(seen.node_count >= 0 && seen.node_count <= kProfileSize / 2,
          "/observation/node_count is no count");
  require(record.stats.residual_relative >= 0, "/stats/residual_relative is not >= 0");
  const double pixels = seen.coverage.sum();
  require(pixels > 0, "/observation/coverage shows nothing");
}

/// Residual and outline from the positions.
void check_drape(const Record& record, const RecordsHeader& header,
                 const std::shared_ptr<const Discretization>& discretization) {
  Potential potential(discretization, record.fabric, header.reading, header.scene.gravity);
  if (record.stats.contact == "support") potential.set_support(support_contact(header.scene));
  const double residual = potential.residual(potential.gradient(record.positions));
  const double allowed = kSameResidual * std::max(record.stats.residual_relative,
                                                  potential.rounding_floor(record.positions));
  std::ostringstream text;
  text << "the residual of its positions is " << residual << ", stored "
       << record.stats.residual_relative;
  require(residual <= allowed, text.str());
  const Observation seen =
      observe(header.scene, discretization->mesh(), record.positions, header.grid);
  require(
      (seen.profile - record.observation.profile).cwiseAbs().maxCoeff() <= kSameOutline &&
          std::abs(seen.drape_coefficient - record.observation.drape_coefficient) <= kSameOutline,
      "profile or drape coefficient are not those of its positions");
  // u16 rounds to 1/131070; sums of another order do not show there
  require((seen.coverage - record.observation.coverage).cwiseAbs().maxCoeff() <= 2e-5,
          "/observation/coverage is not that of its positions");
}

}  // namespace

std::string verify_bytes(const std::filesystem::path& file) {
  try {
    switch (verify_checksum(file)) {
      case ChecksumState::matches:
        return "check sum     as in " + checksum_file(file).filename().string() + "\n";
      case ChecksumState::missing:
        return "check sum     none: there is no " + checksum_file(file).filename().string() + "\n";
      case ChecksumState::differs:
        break;
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw RecordError(error.what());
  }
  throw RecordError(file.string() + ": is not the file whose check sum is in " +
                    checksum_file(file).filename().string() + ": damaged or changed");
}

std::string verify_records(const std::filesystem::path& file, int sample) {
  const RecordsHeader header = read_header(file);
  const auto discretization = std::make_shared<const Discretization>(
      make_mesh(header.rest_uv, header.triangles, header.fixed, header.clamp_wing_factor));
  const size_t count = record_count(file);
  const size_t stride =
      sample > 0 ? std::max<size_t>(1, count / static_cast<size_t>(sample)) : count + 1;
  size_t solved = 0;
  int recomputed = 0;
  std::set<std::string> ids;
  visit_records(file, [&](size_t index, const Record& record) {
    try {
      require(ids.insert(record.id).second, "the id " + record.id + " occurs twice");
      check_ranges(record, header.scene);
      solved += converged(record);
      if (recomputed >= sample || index % stride != 0 || !converged(record)) return;
      ++recomputed;
      check_drape(record, header, discretization);
    } catch (const Broken& broken) {
      throw RecordError(file.string() + ": record " + std::to_string(index) + ": " + broken.reason);
    } catch (const std::exception& error) {
      throw RecordError(file.string() + ": record " + std::to_string(index) + ": " + error.what());
    }
  });
  std::ostringstream text;
  text << "records       " << count << ", " << solved << " of them converged: all readable, "
       << "within their ranges\n"
       << "recomputed    residual and outline of " << recomputed << ": as stored\n";
  return text.str();
}

}  // namespace drape
