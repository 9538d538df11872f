#include "core/hdf5_file.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>

#include "core/hdf5_virtual.h"

namespace drape::hdf5 {
namespace {

/// Speed and size: level 4 takes half the time of level 9 and leaves files a per cent larger.
constexpr unsigned kCompressionLevel = 4;

std::mutex& process_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// The innermost entry of the error stack, which the library clears at the next successful call.
std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* entry, void* result) -> herr_t {
        if (depth == 0 && entry->desc) *static_cast<std::string*>(result) = entry->desc;
        return 0;
      },
      &text);
  return text.empty() ? text : " (" + text + ")";
}

void check(herr_t result, const std::string& what) {
  if (result < 0) throw Error(what + reason());
}

Id text_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "HDF5 text type");
  check(H5Tset_size(type, H5T_VARIABLE), "HDF5 text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "HDF5 text type");
  return type;
}

/// Little-endian on every machine.
template <class T>
Id disk_type() {
  if constexpr (std::is_same_v<T, std::string>) {
    return text_type();
  } else {
    hid_t type = H5I_INVALID_HID;
    if constexpr (std::is_same_v<T, double>) type = H5T_IEEE_F64LE;
    if constexpr (std::is_same_v<T, std::int32_t>) type = H5T_STD_I32LE;
    if constexpr (std::is_same_v<T, std::uint8_t>) type = H5T_STD_U8LE;
    if constexpr (std::is_same_v<T, std::uint16_t>) type = H5T_STD_U16LE;
    if constexpr (std::is_same_v<T, std::uint64_t>) type = H5T_STD_U64LE;
    return Id(H5Tcopy(type), H5Tclose, "HDF5 number type");
  }
}

template <class T>
Id memory_type() {
  return Id(H5Tget_native_type(disk_type<T>(), H5T_DIR_DEFAULT), H5Tclose, "HDF5 memory type");
}

std::string name_of(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return "f" + bits;
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "i") + bits;
    case H5T_STRING:
      return H5Tis_variable_str(type) > 0 ? "text" : "fixed-length text";
    default:
      return "neither number nor text";
  }
}

Shape shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, "unreadable shape");
  Shape shape(static_cast<size_t>(rank));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "unreadable shape");
  return shape;
}

size_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), size_t{1}, std::multiplies<>());
}

/// An empty shape makes a scalar.
Id make_space(const Shape& shape) {
  const hid_t space = shape.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  return Id(space, H5Sclose, "HDF5 shape " + to_string(shape));
}

/// Selects rows [first, first + count) of a space; returns the shape they have in memory.
Shape select_rows(hid_t space, hsize_t first, hsize_t count, const std::string& what) {
  Shape shape = shape_of(space);
  Shape start(shape.size(), 0);
  start.at(0) = first;
  shape.at(0) = count;
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, shape.data(), nullptr),
        what);
  return shape;
}

/// What H5Dread, H5Aread and their writing twins have in common: text goes through char pointers.
/// `transfer(memory type, buffer)` moves the values.
template <class T, class Transfer>
void write_values(const std::vector<T>& values, const std::string& what, Transfer transfer) {
  if constexpr (std::is_same_v<T, std::string>) {
    std::vector<const char*> pointers(values.size());
    std::transform(values.begin(), values.end(), pointers.begin(),
                   [](const std::string& text) { return text.c_str(); });
    check(transfer(memory_type<T>(), static_cast<const void*>(pointers.data())), what);
  } else {
    check(transfer(memory_type<T>(), static_cast<const void*>(values.data())), what);
  }
}

template <class T, class Transfer>
std::vector<T> read_values(const Shape& shape, const std::string& what, Transfer transfer) {
  if constexpr (std::is_same_v<T, std::string>) {
    std::vector<char*> pointers(product(shape), nullptr);
    const Id type = memory_type<T>();
    const Id space = make_space(shape);
    check(transfer(type, static_cast<void*>(pointers.data())), what);
    std::vector<std::string> values;
    for (const char* text : pointers) values.emplace_back(text ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return values;
  } else {
    std::vector<T> values(product(shape));
    check(transfer(memory_type<T>(), static_cast<void*>(values.data())), what);
    return values;
  }
}

/// The format of 1.10 has check sums over the metadata, and is smaller than older ones. No locks: a
/// complete file is never written again, so they protect nothing, and they fail on file systems
/// that have none. The files that virtual datasets show stay open from one dataset to the next.
Id file_access() {
  Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "HDF5 file access");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "HDF5 file access");
  check(H5Pset_file_locking(access, false, true), "HDF5 file access");
  check(H5Pset_elink_file_cache_size(access, 64), "HDF5 file access");
  return access;
}

}  // namespace

Lock::Lock() : guard_(process_mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Id::Id(hid_t id, Closer closer, const std::string& what) : id_(id), closer_(closer) {
  if (id < 0) throw Error(what + reason());
}

Id::~Id() {
  if (id_ >= 0) closer_(id_);
}

void Id::close(const std::string& what) {
  check(closer_(std::exchange(id_, H5I_INVALID_HID)), what);
}

std::string to_string(const Shape& shape) {
  std::string text = "[";
  for (size_t i = 0; i < shape.size(); ++i)
    text += (i ? ", " : "") + (shape[i] == kAnySize ? "any" : std::to_string(shape[i]));
  return text + "]";
}

template <class T>
std::string type_name() {
  return name_of(disk_type<T>());
}

Shape Dataset::shape() const {
  return shape_of(Id(H5Dget_space(id_), H5Sclose, "unreadable shape"));
}

std::string Dataset::type_name() const {
  return name_of(Id(H5Dget_type(id_), H5Tclose, "unreadable type"));
}

bool Dataset::is_number() const {
  const H5T_class_t kind = H5Tget_class(Id(H5Dget_type(id_), H5Tclose, "unreadable type"));
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

template <class T>
std::vector<T> Dataset::read_rows(hsize_t first, hsize_t count) const {
  const Id file_space(H5Dget_space(id_), H5Sclose, "unreadable shape");
  const std::string what = "dataset " + path_ + " cannot be read";
  const Shape shape = select_rows(file_space, first, count, what);
  if (product(shape) == 0) return {};
  const Id memory_space = make_space(shape);
  return read_values<T>(shape, what, [&](hid_t type, void* buffer) {
    return H5Dread(id_, type, memory_space, file_space, H5P_DEFAULT, buffer);
  });
}

File File::create(const std::filesystem::path& path) {
  return File(Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, file_access()), H5Fclose,
                 "cannot be created"),
              path.parent_path());
}

File File::open(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) throw Error("no such file");
  if (H5Fis_hdf5(path.c_str()) <= 0) throw Error("is not an HDF5 file");
  return File(Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose,
                 "is damaged: HDF5 cannot open it"),
              path.parent_path());
}

bool File::has(const std::string& path) const {
  return H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> File::datasets() const {
  std::vector<std::string> paths;
  const auto collect = [](hid_t, const char* name, const H5O_info_t* object, void* list) -> herr_t {
    if (object->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(list)->push_back(std::string("/") + name);
    return 0;
  };
  check(H5Ovisit2(id_, H5_INDEX_NAME, H5_ITER_INC, collect, &paths, H5O_INFO_BASIC),
        "is damaged: its content cannot be listed");
  return paths;
}

template <class T>
void File::create(const std::string& path, const Shape& shape, const Shape& chunk) const {
  const std::string what = "dataset " + path + " cannot be made";
  const Id space = make_space(shape);
  const Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  check(H5Pset_create_intermediate_group(links, 1), what);
  const Id storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  constexpr bool kText = std::is_same_v<T, std::string>;  // filters do not reach its bytes
  if (!kText && product(shape) > 0) {  // the library takes no chunk larger than the dataset
    check(H5Pset_chunk(storage, static_cast<int>(chunk.size()), chunk.data()), what);
    check(H5Pset_shuffle(storage), what);
    check(H5Pset_deflate(storage, kCompressionLevel), what);
    check(H5Pset_fletcher32(storage), what);
  }
  Id(H5Dcreate2(id_, path.c_str(), disk_type<T>(), space, links, storage, H5P_DEFAULT), H5Dclose,
     what)
      .close(what);
}

template <class T>
void File::write_rows(const std::string& path, hsize_t first, hsize_t count,
                      const std::vector<T>& values) const {
  if (values.empty()) return;
  const std::string what = "dataset " + path + " cannot be written";
  const Id data(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Id file_space(H5Dget_space(data), H5Sclose, what);
  const Shape rows = select_rows(file_space, first, count, what);
  const Id memory_space = make_space(rows);
  write_values(values, what, [&](hid_t type, const void* buffer) {
    return H5Dwrite(data, type, memory_space, file_space, H5P_DEFAULT, buffer);
  });
}

Dataset File::dataset(const std::string& path) const {
  Dataset data(path, Id(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose,
                        "dataset " + path + " is missing or damaged"));
  check_sources(data, folder_);
  return data;
}

template <class T>
Dataset File::dataset(const std::string& path, const Shape& expected) const {
  const std::string right = "must be " + hdf5::type_name<T>() + " " + to_string(expected);
  Id id(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose,
        "dataset " + path + " is missing or damaged, " + right);
  Dataset data(path, std::move(id));
  const Shape shape = data.shape();
  const auto fits = [](hsize_t size, hsize_t wanted) {
    return wanted == kAnySize || size == wanted;
  };
  if (data.type_name() != hdf5::type_name<T>() ||
      !std::equal(shape.begin(), shape.end(), expected.begin(), expected.end(), fits))
    throw Error("dataset " + path + " is " + data.type_name() + " " + to_string(shape) + ", " +
                right);
  check_sources(data, folder_);
  return data;
}

namespace {

/// Attributes are written as one scalar or one row of values.
template <class T>
struct AttributeElement {
  using Type = T;
  static constexpr bool kScalar = true;
};
template <class T>
struct AttributeElement<std::vector<T>> {
  using Type = T;
  static constexpr bool kScalar = false;
};

}  // namespace

template <class T>
void File::set_attribute(const std::string& path, const std::string& name, const T& value) const {
  using Element = typename AttributeElement<T>::Type;
  const std::string what = "attribute " + name + " of " + path + " cannot be written";
  std::vector<Element> values;
  Shape shape;
  if constexpr (AttributeElement<T>::kScalar) {
    values = {value};
  } else {
    values = value;
    shape = {values.size()};
  }
  const Id attribute(H5Acreate_by_name(id_, path.c_str(), name.c_str(), disk_type<Element>(),
                                       make_space(shape), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, what);
  write_values(values, what,
               [&](hid_t type, const void* buffer) { return H5Awrite(attribute, type, buffer); });
}

bool File::has_attribute(const std::string& path, const std::string& name) const {
  return H5Aexists_by_name(id_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
T File::attribute(const std::string& path, const std::string& name) const {
  using Element = typename AttributeElement<T>::Type;
  const std::string about = "attribute " + name + " of " + path;
  const Id attribute(H5Aopen_by_name(id_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, about + " is missing or damaged");
  const Shape shape = shape_of(Id(H5Aget_space(attribute), H5Sclose, about + " is damaged"));
  const Id type(H5Aget_type(attribute), H5Tclose, about + " is damaged");
  constexpr bool kScalar = AttributeElement<T>::kScalar;
  if (shape.size() != (kScalar ? 0 : 1) || name_of(type) != hdf5::type_name<Element>())
    throw Error(about + " is " + name_of(type) + " " + to_string(shape) + ", must be " +
                hdf5::type_name<Element>() + (kScalar ? " []" : " [any]"));
  std::vector<Element> values = read_values<Element>(
      shape, about + " is damaged",
      [&](hid_t memory, void* buffer) { return H5Aread(attribute, memory, buffer); });
  if constexpr (kScalar)
    return std::move(values.front());
  else
    return values;
}

void File::close() {
  const herr_t flushed = H5Fflush(id_, H5F_SCOPE_GLOBAL);
  const std::string why = flushed < 0 ? reason() : "";
  id_.close("cannot be closed" + why);
  if (flushed < 0) throw Error("cannot be written" + why);
}

#define DRAPE_HDF5_ELEMENT(T)                                                                    \
  template std::string type_name<T>();                                                           \
  template std::vector<T> Dataset::read_rows<T>(hsize_t, hsize_t) const;                         \
  template void File::create<T>(const std::string&, const Shape&, const Shape&) const;           \
  template void File::write_rows<T>(const std::string&, hsize_t, hsize_t, const std::vector<T>&) \
      const;                                                                                     \
  template Dataset File::dataset<T>(const std::string&, const Shape&) const;
DRAPE_HDF5_ELEMENT(double)
DRAPE_HDF5_ELEMENT(std::int32_t)
DRAPE_HDF5_ELEMENT(std::uint8_t)
DRAPE_HDF5_ELEMENT(std::uint16_t)
DRAPE_HDF5_ELEMENT(std::string)
#undef DRAPE_HDF5_ELEMENT

#define DRAPE_HDF5_ATTRIBUTE(T)                                                                 \
  template void File::set_attribute<T>(const std::string&, const std::string&, const T&) const; \
  template T File::attribute<T>(const std::string&, const std::string&) const;
DRAPE_HDF5_ATTRIBUTE(double)
DRAPE_HDF5_ATTRIBUTE(std::uint64_t)
DRAPE_HDF5_ATTRIBUTE(std::string)
DRAPE_HDF5_ATTRIBUTE(std::vector<double>)
#undef DRAPE_HDF5_ATTRIBUTE

}  // namespace drape::hdf5
