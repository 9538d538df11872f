// Files that HDF5 takes for sound and that are no tables, or tables no longer: everything is read
// or refused as RecordError.
//
// The bytes say which table of the project's own writer is taken, what reads it and how it is
// edited through the library before: objects removed, moved, linked elsewhere, replaced by others
// of any type and shape; attributes likewise; values overwritten. Files that HDF5 itself fails on
// are another matter: the program opens those in a child process (experiments/isolated.h), and
// Debian's library is not instrumented.
#include <fuzzer/FuzzedDataProvider.h>
#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/hdf5_file.h"
#include "core/mesh.h"
#include "core/virtual_records.h"
#include "tests/support/made_up_records.h"

using namespace drape;

namespace {

namespace fs = std::filesystem;

/// A table that the edits begin with.
struct Table {
  std::vector<char> bytes;         ///< the file
  std::vector<std::string> paths;  ///< of its objects; "." is the root
};

/// In memory; gone at the end of the program.
class Folder {
 public:
  Folder() {
    if (!mkdtemp(name_)) abort();
  }
  ~Folder() { fs::remove_all(name_); }
  fs::path path() const { return name_; }

 private:
  char name_[27] = "/dev/shm/drape_fuzz_XXXXXX";
};

fs::path folder() {
  static const Folder only;
  return only.path();
}

std::vector<std::string> paths_in(hid_t file) {
  std::vector<std::string> paths;
  H5Ovisit2(
      file, H5_INDEX_NAME, H5_ITER_NATIVE,
      [](hid_t, const char* name, const H5O_info_t*, void* into) -> herr_t {
        static_cast<std::vector<std::string>*>(into)->push_back(name);
        return 0;
      },
      &paths, H5O_INFO_BASIC);
  return paths;
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = [] {
    const RecordsHeader header = test::make_header();
    std::vector<Record> plain{test::make_record(0, header), test::make_record(1, header)};
    std::vector<Record> estimated = plain, touching = plain;
    estimated[1].estimate = test::make_estimate(1, header);
    touching[0].stats.contact = "support";
    touching[0].contact_force = touching[0].positions;
    std::vector<Table> list;
    const fs::path file = folder() / "table.h5";
    const auto keep = [&] {
      std::ifstream stream(file, std::ios::binary);
      const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      list.push_back({{std::istreambuf_iterator<char>(stream), {}}, paths_in(id)});
      H5Fclose(id);
    };
    for (const auto& records : {plain, estimated, touching}) {
      write_records(file, header, records);
      keep();
    }
    write_records(folder() / "shard.h5", header, plain);
    write_virtual_records(file, header, {folder() / "shard.h5"});
    keep();
    return list;
  }();
  return all;
}

constexpr std::array kTypes{&H5T_NATIVE_DOUBLE_g, &H5T_NATIVE_FLOAT_g,  &H5T_NATIVE_INT32_g,
                            &H5T_NATIVE_UINT16_g, &H5T_NATIVE_UINT64_g, &H5T_NATIVE_INT8_g,
                            &H5T_C_S1_g};

/// A number, a text of fixed length or one of variable length: H5Tclose it.
hid_t any_type(FuzzedDataProvider& bytes) {
  const hid_t type = H5Tcopy(*kTypes[bytes.ConsumeIntegralInRange<size_t>(0, kTypes.size() - 1)]);
  if (H5Tget_class(type) == H5T_STRING) {
    H5Tset_size(type,
                bytes.ConsumeBool() ? H5T_VARIABLE : bytes.ConsumeIntegralInRange<size_t>(1, 40));
    if (bytes.ConsumeBool()) H5Tset_cset(type, H5T_CSET_UTF8);
  }
  return type;
}

hid_t any_space(FuzzedDataProvider& bytes) {
  constexpr std::array<hsize_t, 10> kSizes{0, 1, 2, 3, 5, 6, 7, 8, 360, 1000};
  hsize_t sizes[3];
  const int rank = bytes.ConsumeIntegralInRange(-1, 3);
  if (rank < 0) return H5Screate(H5S_NULL);
  hsize_t count = 1;
  for (hsize_t& size : sizes) {
    size = bytes.ConsumeBool() ? bytes.ConsumeIntegralInRange<hsize_t>(0, 12)
                               : kSizes[bytes.ConsumeIntegralInRange<size_t>(0, kSizes.size() - 1)];
    if (count * size > 1000) size = 1;  // quick to write and to read
    count *= size;
  }
  return H5Screate_simple(rank, sizes, nullptr);
}

/// Memory for all values of a dataset or attribute, the first of them from the bytes.
std::vector<char> any_values(FuzzedDataProvider& bytes, hid_t type, hid_t space,
                             std::vector<std::string>& texts) {
  const hssize_t count = std::max<hssize_t>(1, H5Sget_simple_extent_npoints(space));
  std::vector<char> values(static_cast<size_t>(count) * H5Tget_size(type));
  if (H5Tis_variable_str(type) > 0) {
    texts.emplace_back(bytes.ConsumeRandomLengthString(64));
    const char* text = texts.back().c_str();
    for (size_t i = 0; i < values.size(); i += sizeof text)
      std::copy_n(reinterpret_cast<const char*>(&text), sizeof text, &values[i]);
    return values;
  }
  const std::string some = bytes.ConsumeRandomLengthString(64);
  std::copy_n(some.begin(), std::min(some.size(), values.size()), values.begin());
  return values;
}

void put_dataset(FuzzedDataProvider& bytes, hid_t file, const std::string& path) {
  std::vector<std::string> texts;
  const hid_t type = any_type(bytes), space = any_space(bytes);
  const hid_t set =
      H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (set >= 0) {
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
             any_values(bytes, type, space, texts).data());
    H5Dclose(set);
  }
  H5Sclose(space);
  H5Tclose(type);
}

bool shows_another_file(hid_t set) {
  const hid_t list = H5Dget_create_plist(set);
  const bool shows = H5Pget_layout(list) == H5D_VIRTUAL;
  H5Pclose(list);
  return shows;
}

/// Other values in a dataset that stays; those of a view are the other file's.
void overwrite(FuzzedDataProvider& bytes, hid_t file, const std::string& path) {
  const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  if (set < 0) return;
  if (shows_another_file(set)) {
    H5Dclose(set);
    return;
  }
  std::vector<std::string> texts;
  const hid_t stored = H5Dget_type(set), space = H5Dget_space(set);
  const hid_t type = H5Tget_native_type(stored, H5T_DIR_DEFAULT);
  H5Tclose(stored);
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, any_values(bytes, type, space, texts).data());
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(set);
}

void edit_attribute(FuzzedDataProvider& bytes, hid_t file, const std::string& path) {
  const hid_t object = H5Oopen(file, path.c_str(), H5P_DEFAULT);
  if (object < 0) return;
  H5O_info_t info;
  H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS);
  if (info.num_attrs > 0) {
    char name[64] = "";
    H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC,
                       bytes.ConsumeIntegralInRange<hsize_t>(0, info.num_attrs - 1), name,
                       sizeof name, H5P_DEFAULT);
    H5Adelete(object, name);
    if (bytes.ConsumeBool()) {
      std::vector<std::string> texts;
      const hid_t type = any_type(bytes), space = any_space(bytes);
      const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
      if (attribute >= 0) {
        H5Awrite(attribute, type, any_values(bytes, type, space, texts).data());
        H5Aclose(attribute);
      }
      H5Sclose(space);
      H5Tclose(type);
    }
  }
  H5Oclose(object);
}

void edit(FuzzedDataProvider& bytes, hid_t file, const std::vector<std::string>& paths) {
  const auto any = [&] { return paths[bytes.ConsumeIntegralInRange<size_t>(0, paths.size() - 1)]; };
  const std::string path = any();
  switch (bytes.ConsumeIntegralInRange(0, 7)) {
    case 0:
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      return;
    case 1:
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      return put_dataset(bytes, file, path);
    case 2:
      return overwrite(bytes, file, path);
    case 3:
      return edit_attribute(bytes, file, path);
    case 4:
      return edit_attribute(bytes, file, ".");
    case 5: {  // of another's type and shape; HDF5 1.10 crashes on the copy of many attributes
      const hid_t bare = H5Pcreate(H5P_OBJECT_COPY);
      H5Pset_copy_object(bare, H5O_COPY_WITHOUT_ATTR_FLAG);
      const std::string other = any();
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      H5Ocopy(file, other.c_str(), file, path.c_str(), bare, H5P_DEFAULT);
      H5Pclose(bare);
      return;
    }
    case 6:
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      H5Lcreate_soft(any().c_str(), file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);  // or a loop
      return;
    case 7:
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      H5Lcreate_hard(file, any().c_str(), file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      return;
  }
}

template <class Action>
void reads_or_refuses(Action action) {
  try {
    action();
  } catch (const RecordError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  FuzzedDataProvider bytes(data, size);
  const Table& table = tables()[bytes.ConsumeIntegralInRange<size_t>(0, tables().size() - 1)];
  const int reader = bytes.ConsumeIntegralInRange(0, 2);
  const fs::path path = folder() / "edited.h5";
  std::ofstream(path, std::ios::binary)
      .write(table.bytes.data(), static_cast<std::streamsize>(table.bytes.size()));
  {
    const hdf5::Lock lock;  // and no words on stderr
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (file < 0) abort();
    for (int edits = bytes.ConsumeIntegralInRange(1, 4); edits > 0; --edits)
      edit(bytes, file, table.paths);
    H5Fclose(file);
  }
  switch (reader) {
    case 0:
      reads_or_refuses([&] {
        for (const Record& record : read_records(path)) validate(record.fabric);
      });
      break;
    case 1:
      reads_or_refuses([&] {
        const RecordsHeader header = read_header(path);
        try {
          make_mesh(header.rest_uv, header.triangles, header.fixed, header.clamp_wing_factor);
        } catch (const std::invalid_argument&) {
        }
      });
      break;
    default:
      reads_or_refuses([&] { describe_records(path); });
  }
  return 0;
}
