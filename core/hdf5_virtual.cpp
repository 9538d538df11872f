#include "core/hdf5_virtual.h"

#include <set>

namespace drape::hdf5 {
namespace {

void check(herr_t result, const std::string& what) {
  if (result < 0) throw Error(what);
}

Id space_of(const Shape& shape, const std::string& what) {
  return Id(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
            what);
}

}  // namespace

void create_virtual(const File& target, const Dataset& like, const std::string& path,
                    const std::vector<RowSource>& sources) {
  const std::string what = "virtual dataset " + path + " cannot be made";
  Shape shape = like.shape();
  shape.at(0) = 0;
  for (const RowSource& source : sources) shape[0] += source.rows;
  const Id space = space_of(shape, what);
  const Id storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  Shape start(shape.size(), 0);
  for (const RowSource& source : sources) {
    Shape rows = shape;
    rows[0] = source.rows;
    if (source.has_column && source.rows > 0) {
      check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, rows.data(), nullptr),
            what);
      check(H5Pset_virtual(storage, space, source.file.c_str(), path.c_str(), space_of(rows, what)),
            what);
    }
    start[0] += source.rows;
  }
  check(H5Sselect_all(space), what);
  const Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  check(H5Pset_create_intermediate_group(links, 1), what);
  const Id type(H5Dget_type(like.id()), H5Tclose, what);
  Id(H5Dcreate2(target.id(), path.c_str(), type, space, links, storage, H5P_DEFAULT), H5Dclose,
     what)
      .close(what);
}

void check_sources(const Dataset& data, const std::filesystem::path& folder) {
  const std::string what = "virtual datasets cannot be read";
  const Id storage(H5Dget_create_plist(data.id()), H5Pclose, what);
  if (H5Pget_layout(storage) != H5D_VIRTUAL) return;
  size_t count = 0;
  check(H5Pget_virtual_count(storage, &count), what);
  std::set<std::filesystem::path> missing;
  for (size_t i = 0; i < count; ++i) {
    const ssize_t length = H5Pget_virtual_filename(storage, i, nullptr, 0);
    if (length < 0) throw Error(what);
    std::string source(static_cast<size_t>(length) + 1, '\0');
    if (H5Pget_virtual_filename(storage, i, source.data(), source.size()) < 0) throw Error(what);
    source.resize(static_cast<size_t>(length));
    if (!std::filesystem::is_regular_file(folder / source)) missing.insert(folder / source);
  }
  if (!missing.empty())
    throw Error(
        "shows the records of " + missing.begin()->string() + ", which is not there" +
        (missing.size() > 1 ? " (nor are " + std::to_string(missing.size() - 1) + " others)" : ""));
}

}  // namespace drape::hdf5
