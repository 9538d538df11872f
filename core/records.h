// Records: fabrics, their equilibria and what is seen of them, in HDF5 (schema drape-records 3).
//
// One file holds a table of N fabrics on one mesh: /mesh/<id>, /fabric, /params, /sim,
// /observation, /stats, and /params_estimated, /sim_estimated, /estimate where an estimate was
// made. Columns, not compounds; SI units.
//
// Safety: a run keeps every finished record as a file of its own (the same schema with N = 1),
// which appears under its final name only when it is complete and on disk (write to NAME.part,
// fsync, rename, fsync of the folder). The table results.h5 is consolidated from these files. A
// process killed at any moment therefore loses no record whose write returned.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/coverage.h"
#include "core/fabric.h"
#include "core/mesh.h"
#include "core/scene.h"
#include "core/types.h"

namespace drape {

/// Thrown for a file that is missing, damaged, or of another schema; what() names file and reason.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// What all records of one file share.
struct RecordsHeader {
  std::string config;      ///< the resolved config, verbatim
  std::uint64_t seed = 0;  ///< experiment.seed
  std::string git_commit;
  std::string compiler;
  std::string mesh_id = "disc";
  Points2 rest_uv;
  Triangles triangles;
  std::vector<std::uint8_t> fixed;
  double clamp_wing_factor = 2;
  Scene scene;
  BendingReading reading;
  PixelGrid grid;  ///< of /observation/coverage
};

/// How a solve went, one value a record (/stats).
struct SolveStats {
  std::string status;    ///< "converged" or the reason of failure
  std::string protocol;  ///< how the branch was chosen
  double residual_relative = 0;
  double rounding_floor = 0;
  int newton_iterations = 0;
  int factorizations = 0;
  int negative_eigenvalues = 0;
  int wings_past_threshold = 0;
  double energy = 0;  ///< [J]
  double cpu_seconds = 0;
  std::string contact = "off";  ///< what acts: "off" or "support"
  int self_intersections = -1;  ///< crossing pairs of triangles; -1 where nothing was solved
  double support_penetration = kNotKnown;  ///< deepest vertex [m]
};

/// What is seen of a drape (/observation). Where the solve failed: NaN, a coverage of zero.
struct Observation {
  VecX profile;            ///< kProfileSize radii [m]
  CoverageImage coverage;  ///< [0, 1], on RecordsHeader::grid; stored as u16, full scale = covered
  double drape_coefficient = 0;  ///< fraction
  int node_count = 0;
};

/// The outcome of an estimation (/params_estimated, /params_estimated_log_sd,
/// /params_estimated_picture_share, /sim_estimated, /estimate).
struct EstimateRecord {
  Fabric fabric;
  Fabric start;  ///< the first parameters of the fit (/params_start)
  /// Both NaN where a parameter was held. The share: 1 - posterior over prior variance.
  ParameterVector log_sd = ParameterVector::Constant(kNotKnown), picture_share = log_sd;
  /// Effective (B_u, B_v, B_45) [N m] and the standard deviations of their logarithms.
  VecX rigidity = Vec3::Constant(kNotKnown), rigidity_log_sd = rigidity;
  VecX positions;    ///< 3n
  SolveStats stats;  ///< of the estimated state; status "recovered" and so on is in `outcome`
  /// Where the observation lies on the drape: its origin in the drape's frame [m], the direction
  /// of the weft in it [rad], and the logarithm of true over nominal length.
  VecX centre = VecX::Zero(2);
  double weft_angle = 0, log_scale = 0;
  std::string outcome;  ///< "succeeded" or the reason why not
  bool branch_shared = false;
  double outline_rms = 0;  ///< [m]
  double iou = 0;
  double drape_coefficient = 0;
  int node_count = 0;
  int forward_solves = 0;
  VecX profile;        ///< of the estimated state [m]
  VecX start_profile;  ///< of the start [m]
};

/// One fabric with its tag, its equilibrium and its observation.
struct Record {
  std::string id;
  std::string name;
  std::string category, subcategory, type, composition;  ///< the tag; empty if unknown
  Fabric fabric;
  VecX positions;      ///< 3n [m]; NaN where the solve failed
  VecX contact_force;  ///< of the support on every vertex (3n) [N]; empty where contact is off
  SolveStats stats;
  Observation observation;
  std::optional<EstimateRecord> estimate;
};

/// Writes a table atomically and durably (NAME.part, fsync, rename). All records must have the same
/// vertex count as the header. Throws RecordError when the disk refuses, std::invalid_argument on
/// sizes that do not match.
void write_records(const std::filesystem::path& file, const RecordsHeader& header,
                   const std::vector<Record>& records);

/// The same for a table larger than memory: `record(index)` is called for 0, 1, ... in order, and
/// may itself read files of records. What it throws passes through.
void write_records(const std::filesystem::path& file, const RecordsHeader& header, size_t count,
                   const std::function<Record(size_t index)>& record);

/// The header of a table; throws RecordError.
RecordsHeader read_header(const std::filesystem::path& file);
/// How many records a table has; throws RecordError.
size_t record_count(const std::filesystem::path& file);
/// All records of a table, or `count` of them from `first` on; throws RecordError.
std::vector<Record> read_records(const std::filesystem::path& file);
std::vector<Record> read_records(const std::filesystem::path& file, size_t first, size_t count);
/// Calls `visit` for all records of a table in order, some in memory at a time; throws RecordError.
void visit_records(const std::filesystem::path& file,
                   const std::function<void(size_t index, const Record& record)>& visit);

/// A text of some lines: schema, provenance, mesh, number of records, columns with shapes and
/// ranges, share of converged solves. Throws RecordError.
std::string describe_records(const std::filesystem::path& file);

}  // namespace drape
