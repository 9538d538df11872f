#include "core/record_header.h"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

std::string mesh_path(const RecordsHeader& header) { return "/mesh/" + header.mesh_id; }

}  // namespace

void check(const RecordsHeader& header) {
  const auto require = [](bool fulfilled, const std::string& message) {
    if (!fulfilled) throw std::invalid_argument(message);
  };
  const Eigen::Index vertices = header.rest_uv.rows();
  require(!header.mesh_id.empty() && header.mesh_id.find_first_of("/.") == std::string::npos,
          "mesh id '" + header.mesh_id + "': must be a name without '/' and '.'");
  require(header.rest_uv.allFinite(), "mesh rest_uv: must be finite");
  require(header.triangles.rows() > 0, "mesh triangles: must be at least one");
  require(header.triangles.minCoeff() >= 0 && header.triangles.maxCoeff() < vertices,
          "mesh triangles hold the vertices " + std::to_string(header.triangles.minCoeff()) +
              " to " + std::to_string(header.triangles.maxCoeff()) + ": must be within 0 to " +
              std::to_string(vertices - 1));
  require(static_cast<Eigen::Index>(header.fixed.size()) == vertices,
          "mesh fixed has " + std::to_string(header.fixed.size()) + " values: must have " +
              std::to_string(vertices));
  require(std::all_of(header.fixed.begin(), header.fixed.end(), [](auto f) { return f <= 1; }),
          "mesh fixed: must be 0 or 1");
  require(header.clamp_wing_factor > 0 && std::isfinite(header.clamp_wing_factor),
          "clamp_wing_factor: must be finite and > 0");
  require(header.grid.rows > 0 && header.grid.columns > 0 && header.grid.pixel_size > 0 &&
              std::isfinite(header.grid.pixel_size) && header.grid.origin.allFinite(),
          "pixel grid: must have rows, columns, a pixel size > 0 m and a finite origin");
  validate(header.scene);
}

hdf5::File open_records(const std::filesystem::path& path) {
  hdf5::File file = hdf5::File::open(path);
  std::string schema;
  try {
    schema = file.attribute<std::string>("/", "schema");
  } catch (const hdf5::Error& error) {
    throw hdf5::Error(std::string(error.what()) + ": not written by drape; must be \"" + kSchema +
                      "\"");
  }
  if (schema != kSchema)
    throw hdf5::Error("has the schema \"" + schema + "\", must be \"" + kSchema + "\"");
  const std::uint64_t version = schema_version(file);
  if (version < 1 || version > kSchemaVersion)
    throw hdf5::Error("has version " + std::to_string(version) + " of " + kSchema +
                      ", this program reads versions 1 to " + std::to_string(kSchemaVersion) +
                      (version > kSchemaVersion ? ": use a newer program" : ""));
  return file;
}

std::uint64_t schema_version(const hdf5::File& file) {
  return file.attribute<std::uint64_t>("/", "version");
}

void write_header(const hdf5::File& file, const RecordsHeader& header) {
  file.set_attribute<std::string>("/", "schema", kSchema);
  file.set_attribute("/", "version", kSchemaVersion);
  file.set_attribute("/", "config", header.config);
  file.set_attribute("/", "seed", header.seed);
  file.set_attribute("/", "git_commit", header.git_commit);
  file.set_attribute("/", "compiler", header.compiler);
  file.set_attribute("/", "gravity", header.scene.gravity);
  file.set_attribute("/", "specimen_radius", header.scene.specimen_radius);
  file.set_attribute("/", "support_radius", header.scene.support_radius);
  file.set_attribute("/", "column_radius", header.scene.column_radius);
  file.set_attribute("/", "bending_law", std::string(name(header.reading.law)));
  file.set_attribute("/", "bending_threshold", std::string(name(header.reading.threshold)));

  const std::string mesh = mesh_path(header);
  const auto vertices = static_cast<hsize_t>(header.rest_uv.rows());
  const auto triangles = static_cast<hsize_t>(header.triangles.rows());
  const auto uv = header.rest_uv.reshaped<Eigen::RowMajor>();
  const auto corners = header.triangles.reshaped<Eigen::RowMajor>();
  file.write<double>(mesh + "/rest_uv", {vertices, 2}, {vertices, 2}, {uv.begin(), uv.end()});
  file.set_attribute<std::string>(mesh + "/rest_uv", "units", "m");
  file.write<std::int32_t>(mesh + "/triangles", {triangles, 3}, {triangles, 3},
                           {corners.begin(), corners.end()});
  file.write<std::uint8_t>(mesh + "/fixed", {vertices}, {vertices}, header.fixed);
  file.set_attribute(mesh, "clamp_wing_factor", header.clamp_wing_factor);

  file.set_attribute("/sim", "mesh", header.mesh_id);
  const PixelGrid& grid = header.grid;
  file.set_attribute("/observation/coverage", "pixel_size_m", grid.pixel_size);
  file.set_attribute<std::vector<double>>("/observation/coverage", "origin_m",
                                          {grid.origin.x(), grid.origin.y()});
}

RecordsHeader read_header(const hdf5::File& file) {
  using hdf5::kAnySize;
  RecordsHeader header;
  header.config = file.attribute<std::string>("/", "config");
  header.seed = file.attribute<std::uint64_t>("/", "seed");
  header.git_commit = file.attribute<std::string>("/", "git_commit");
  header.compiler = file.attribute<std::string>("/", "compiler");
  header.scene.gravity = file.attribute<double>("/", "gravity");
  header.scene.specimen_radius = file.attribute<double>("/", "specimen_radius");
  header.scene.support_radius = file.attribute<double>("/", "support_radius");
  if (schema_version(file) >= 2)
    header.scene.column_radius = file.attribute<double>("/", "column_radius");
  header.reading.law = bending_law_from_name(file.attribute<std::string>("/", "bending_law"));
  header.reading.threshold =
      bending_threshold_from_name(file.attribute<std::string>("/", "bending_threshold"));

  header.mesh_id = file.attribute<std::string>("/sim", "mesh");
  const std::string mesh = mesh_path(header);
  const auto uv = file.dataset<double>(mesh + "/rest_uv", {kAnySize, 2}).read<double>();
  const auto corners =
      file.dataset<std::int32_t>(mesh + "/triangles", {kAnySize, 3}).read<std::int32_t>();
  header.rest_uv =
      Eigen::Map<const Points2>(uv.data(), static_cast<Eigen::Index>(uv.size() / 2), 2);
  header.triangles =
      Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  header.fixed = file.dataset<std::uint8_t>(mesh + "/fixed", {uv.size() / 2}).read<std::uint8_t>();
  header.clamp_wing_factor = file.attribute<double>(mesh, "clamp_wing_factor");

  const std::string coverage = "/observation/coverage";
  const hdf5::Shape images =
      file.dataset<std::uint16_t>(coverage, {kAnySize, kAnySize, kAnySize}).shape();
  header.grid.rows = static_cast<int>(images[1]);
  header.grid.columns = static_cast<int>(images[2]);
  header.grid.pixel_size = file.attribute<double>(coverage, "pixel_size_m");
  const auto origin = file.attribute<std::vector<double>>(coverage, "origin_m");
  if (origin.size() != 2)
    throw hdf5::Error("attribute origin_m of " + coverage + ": must be [x, y]");
  header.grid.origin = {origin[0], origin[1]};

  check(header);
  return header;
}

}  // namespace drape
