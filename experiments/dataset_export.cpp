#include "experiments/dataset_export.h"

#include <sstream>
#include <stdexcept>

#include "core/durable_file.h"
#include "core/records.h"
#include "experiments/model.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// A stream that writes every double so that it reads back the same.
std::ostringstream exact_stream() {
  std::ostringstream stream;
  stream.precision(17);
  return stream;
}

void write_new(const fs::path& out, const std::string& text) {
  if (fs::exists(out))
    throw std::invalid_argument(out.string() + ": is there already; choose another name");
  write_text_durably(out, text);
}

/// As RFC 4180 has it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

Record draped_record(const fs::path& file, size_t index) {
  const size_t count = record_count(file);
  if (index >= count)
    throw std::invalid_argument(file.string() + ": has " + std::to_string(count) +
                                " records, from 0; there is no record " + std::to_string(index));
  Record record = read_records(file, index, 1).at(0);
  if (!converged(record))
    throw std::invalid_argument(file.string() + ": record " + std::to_string(index) +
                                " has no drape: " + record.stats.status);
  return record;
}

}  // namespace

void export_csv(const fs::path& file, const fs::path& out) {
  std::ostringstream text = exact_stream();
  text << "id,name,category,subcategory,type,composition_percent";
  for (Parameter p : all_parameters()) text << "," << name(p);
  text << ",drape_coefficient,node_count,status,protocol,contact,residual_relative,"
          "negative_eigenvalues,wings_past_threshold,self_intersections,energy,cpu_seconds\n";
  visit_records(file, [&](size_t, const Record& record) {
    text << cell(record.id) << "," << cell(record.name) << "," << cell(record.category) << ","
         << cell(record.subcategory) << "," << cell(record.type) << "," << cell(record.composition);
    for (Parameter p : all_parameters()) text << "," << record.fabric[p];
    const SolveStats& stats = record.stats;
    text << "," << record.observation.drape_coefficient << "," << record.observation.node_count
         << "," << cell(stats.status) << "," << cell(stats.protocol) << "," << stats.contact << ","
         << stats.residual_relative << "," << stats.negative_eigenvalues << ","
         << stats.wings_past_threshold << "," << stats.self_intersections << "," << stats.energy
         << "," << stats.cpu_seconds << "\n";
  });
  write_new(out, text.str());
}

void export_obj(const fs::path& file, size_t index, const fs::path& out) {
  const RecordsHeader header = read_header(file);
  const Record record = draped_record(file, index);
  std::ostringstream text = exact_stream();
  text << "# drape of fabric " << record.id << ": " << record.type << ", " << record.composition
       << "; metres, z up; texture coordinates: the flat specimen, x = weft\n";
  for (Eigen::Index i = 0; i < header.rest_uv.rows(); ++i)
    text << "v " << record.positions[3 * i] << " " << record.positions[3 * i + 1] << " "
         << record.positions[3 * i + 2] << "\n";
  for (Eigen::Index i = 0; i < header.rest_uv.rows(); ++i)
    text << "vt " << header.rest_uv(i, 0) << " " << header.rest_uv(i, 1) << "\n";
  for (Eigen::Index t = 0; t < header.triangles.rows(); ++t) {
    text << "f";
    for (Eigen::Index c = 0; c < 3; ++c)
      text << " " << header.triangles(t, c) + 1 << "/" << header.triangles(t, c) + 1;
    text << "\n";
  }
  write_new(out, text.str());
}

void export_vtu(const fs::path& file, size_t index, const fs::path& out) {
  const RecordsHeader header = read_header(file);
  const Record record = draped_record(file, index);
  const Eigen::Index vertices = header.rest_uv.rows(), triangles = header.triangles.rows();
  std::ostringstream text = exact_stream();
  const auto array = [&text](const char* type, const char* name, int components, const auto& fill) {
    text << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
         << components << "\" format=\"ascii\">\n";
    fill();
    text << "\n</DataArray>\n";
  };
  const auto vectors = [&](const VecX& values) {
    for (const double value : values) text << value << " ";
  };
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << vertices << "\" NumberOfCells=\"" << triangles << "\">\n<Points>\n";
  array("Float64", "positions_m", 3, [&] { vectors(record.positions); });
  text << "</Points>\n<PointData>\n";
  array("Float64", "rest_uv_m", 2, [&] {
    for (Eigen::Index i = 0; i < vertices; ++i)
      text << header.rest_uv(i, 0) << " " << header.rest_uv(i, 1) << " ";
  });
  array("UInt8", "fixed", 1, [&] {
    for (const std::uint8_t fixed : header.fixed) text << int{fixed} << " ";
  });
  if (record.contact_force.size() > 0)
    array("Float64", "contact_force_N", 3, [&] { vectors(record.contact_force); });
  text << "</PointData>\n<Cells>\n";
  array("Int32", "connectivity", 1, [&] {
    for (const auto corner : header.triangles.reshaped<Eigen::RowMajor>()) text << corner << " ";
  });
  array("Int32", "offsets", 1, [&] {
    for (Eigen::Index t = 1; t <= triangles; ++t) text << 3 * t << " ";
  });
  array("UInt8", "types", 1, [&] {
    constexpr int kVtkTriangle = 5;
    for (Eigen::Index t = 0; t < triangles; ++t) text << kVtkTriangle << " ";
  });
  text << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  write_new(out, text.str());
}

}  // namespace drape
