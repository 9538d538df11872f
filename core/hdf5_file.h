// Owners of HDF5 objects: a file, its datasets and its attributes; errors become exceptions.
//
// Nothing of Drape is in here. Only some builds of HDF5 are thread-safe (Debian's is): hold a Lock
// during every use of the library, the destructors of File and Dataset included.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drape::hdf5 {

/// What went wrong, with the library's innermost reason; the name of the file is not in it.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The one process-wide lock. Keeps the library from printing its error stack to stderr.
class Lock {
 public:
  Lock();

 private:
  std::lock_guard<std::mutex> guard_;
};

/// One identifier of the library, closed at the end of its life.
class Id {
 public:
  using Closer = herr_t (*)(hid_t);
  /// Throws Error, opening with `what`, if the library returned no valid identifier.
  Id(hid_t id, Closer closer, const std::string& what);
  Id(Id&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Id& operator=(Id&&) = delete;
  ~Id();

  operator hid_t() const { return id_; }
  /// Closes now and throws Error, opening with `what`, if that fails.
  void close(const std::string& what);

 private:
  hid_t id_;
  Closer closer_;
};

/// Sizes of a dataset, slowest dimension first.
using Shape = std::vector<hsize_t>;
inline constexpr hsize_t kAnySize = H5S_UNLIMITED;  ///< in an expected shape: no condition

/// "[15, 2048, 3]"; kAnySize is written "any".
std::string to_string(const Shape& shape);

/// Short name of an element type: "f64", "i32", "u16", "u8", "text" (variable-length string), ...
/// T: double, std::int32_t, std::uint8_t, std::uint16_t or std::string, as everywhere below.
template <class T>
std::string type_name();

/// A dataset; its rows run along the first dimension.
class Dataset {
 public:
  Dataset(std::string path, Id id) : path_(std::move(path)), id_(std::move(id)) {}
  Shape shape() const;
  std::string type_name() const;
  bool is_number() const;
  hid_t id() const { return id_; }
  /// All values of the rows [first, first + count), the last dimension fastest. Numbers are
  /// converted to T. Throws Error if the file is damaged or the types cannot be converted.
  template <class T>
  std::vector<T> read_rows(hsize_t first, hsize_t count) const;
  template <class T>
  std::vector<T> read() const {
    return read_rows<T>(0, shape().at(0));
  }

 private:
  std::string path_;
  Id id_;
};

/// An HDF5 file. Paths inside it start with "/"; missing groups on the way are made when writing.
class File {
 public:
  static File create(const std::filesystem::path& path);
  static File open(const std::filesystem::path& path);  ///< for reading

  hid_t id() const { return id_; }
  bool has(const std::string& path) const;  ///< a group, or a dataset in a group that is there
  /// Paths of all datasets, sorted.
  std::vector<std::string> datasets() const;

  /// Makes a dataset. Numbers are stored in chunks of the given shape, each compressed (gzip after
  /// shuffle) and with a check sum, so that damage shows when it is read; text is stored as it is.
  template <class T>
  void create(const std::string& path, const Shape& shape, const Shape& chunk) const;
  /// Writes its rows [first, first + count). Rows never written read as zero.
  template <class T>
  void write_rows(const std::string& path, hsize_t first, hsize_t count,
                  const std::vector<T>& values) const;
  /// Both, for all rows.
  template <class T>
  void write(const std::string& path, const Shape& shape, const Shape& chunk,
             const std::vector<T>& values) const {
    create<T>(path, shape, chunk);
    write_rows(path, 0, shape.at(0), values);
  }
  /// Throws Error, which names what is there and what should be, if it is missing, or if it shows
  /// rows of a file that is missing.
  Dataset dataset(const std::string& path) const;
  /// The same for a dataset of another element type or shape than expected.
  template <class T>
  Dataset dataset(const std::string& path, const Shape& expected) const;

  /// Attributes of the object at `path`; T: double, std::uint64_t, std::string, or a vector of
  /// double, which makes a one-dimensional attribute. Reading throws Error if it is missing or of
  /// another kind.
  template <class T>
  void set_attribute(const std::string& path, const std::string& name, const T& value) const;
  bool has_attribute(const std::string& path, const std::string& name) const;
  template <class T>
  T attribute(const std::string& path, const std::string& name) const;

  /// Hands everything to the operating system and closes; throws Error if the disk refuses.
  /// Datasets must be gone before.
  void close();

 private:
  File(Id id, std::filesystem::path folder) : id_(std::move(id)), folder_(std::move(folder)) {}
  Id id_;
  std::filesystem::path folder_;
};

}  // namespace drape::hdf5
