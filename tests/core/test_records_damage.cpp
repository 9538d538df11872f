// Files that are no table, of another schema, incomplete or damaged: refused, with the reason.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <iterator>

#include "tests/support/records_fixture.h"

namespace drape {
namespace {

using namespace test;

void overwrite_text(hid_t file, const char* attribute, const char* text) {
  const hid_t id = H5Aopen_by_name(file, "/", attribute, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(id);
  ASSERT_GE(H5Awrite(id, type, &text), 0);
  H5Tclose(type);
  H5Aclose(id);
}

void overwrite_number(hid_t file, const char* object, const char* attribute, double number) {
  const hid_t id = H5Aopen_by_name(file, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(id, H5T_NATIVE_DOUBLE, &number), 0);
  H5Aclose(id);
}

void overwrite_first(hid_t file, const char* dataset, double number) {
  const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hid_t space = H5Dget_space(id);
  hsize_t zeros[3] = {0, 0, 0}, ones[3] = {1, 1, 1};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, zeros, nullptr, ones, nullptr);
  const hid_t one = H5Screate_simple(1, ones, nullptr);
  ASSERT_GE(H5Dwrite(id, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &number), 0);
  H5Sclose(one);
  H5Sclose(space);
  H5Dclose(id);
}

TEST_F(Records, WhatIsNoFileOfRecordsIsNamed) {
  EXPECT_TRUE(contains(error(), "results.h5: no such file"));
  std::ofstream(file_) << "not HDF5";
  EXPECT_TRUE(contains(error(), "results.h5: is not an HDF5 file"));
  H5Fclose(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_TRUE(contains(error(), "attribute schema of / is missing"));
  EXPECT_TRUE(contains(error(), "must be \"drape-records\""));
}

TEST_F(Records, WhatIsWrongInAFileIsNamed) {
  const auto named = [this](const std::function<void(hid_t)>& edit, const std::string& message) {
    write_example();
    change(edit);
    EXPECT_TRUE(contains(error(), "results.h5: "));
    EXPECT_TRUE(contains(error(), message));
  };
  named([](hid_t file) { overwrite_text(file, "schema", "other"); },
        "has the schema \"other\", must be \"drape-records\"");
  named([](hid_t file) { overwrite_number(file, "/", "version", 4); },
        "has version 4 of drape-records, this program reads versions 1 to 3: use a newer program");
  named([](hid_t file) { H5Adelete(file, "gravity"); }, "attribute gravity of / is missing");
  named([](hid_t file) { overwrite_number(file, "/", "gravity", -1); }, "scene gravity = -1");
  named([](hid_t file) { overwrite_text(file, "bending_law", "cubic"); }, "bending law 'cubic'");
  named([](hid_t file) { H5Ldelete(file, "/params/k_bh", H5P_DEFAULT); },
        "dataset /params/k_bh is missing or damaged, must be f64 [2]");
  named([](hid_t file) { H5Ldelete(file, "/observation", H5P_DEFAULT); },
        "dataset /observation/coverage is missing or damaged, must be u16 [any, any, any]");
  named([](hid_t file) { H5Lmove(file, "/mesh/disc_7/fixed", file, "/sim/positions2", {}, {}); },
        "dataset /mesh/disc_7/fixed is missing");
  named(
      [](hid_t file) {
        H5Ldelete(file, "/sim/positions", H5P_DEFAULT);
        H5Lcreate_hard(file, "/observation/profile", file, "/sim/positions", {}, {});
      },
      "dataset /sim/positions is f64 [2, 360], must be f64 [2, 7, 3]");
  named(
      [](hid_t file) {
        H5Ldelete(file, "/params/k_u", H5P_DEFAULT);
        H5Lcreate_hard(file, "/fabric/name", file, "/params/k_u", {}, {});
      },
      "dataset /params/k_u is text [2], must be f64 [2]");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/rest_uv", kNaN); },
        "rest_uv: must be finite");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/triangles", 7); },
        "hold the vertices 0 to 7: must be within 0 to 6");
  named([](hid_t file) { overwrite_first(file, "/mesh/disc_7/fixed", 3); },
        "fixed: must be 0 or 1");
  named([](hid_t file) { overwrite_first(file, "/params/areal_density", -0.1); },
        "record 0: fabric parameter areal_density = -0.1");
}

TEST_F(Records, WhatIsNoColumnIsNotDescribed) {
  write_example();
  change([](hid_t file) {
    H5Ldelete(file, "/stats/status", H5P_DEFAULT);
    const hid_t scalar = H5Screate(H5S_SCALAR);
    H5Dclose(H5Dcreate2(file, "/stats/status", H5T_NATIVE_INT32, scalar, {}, {}, {}));
    H5Sclose(scalar);
  });
  try {
    describe_records(file_);
    FAIL() << "a number was taken for a column of texts";
  } catch (const RecordError& error) {
    EXPECT_TRUE(contains(error.what(), "dataset /stats/status is i32 [], must be text [any]"));
  }
}

TEST_F(Records, TruncatedFilesAreRefused) {
  write_example();
  const auto size = fs::file_size(file_);
  for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{100}}) {
    fs::resize_file(file_, left);
    EXPECT_TRUE(contains(error(), "results.h5: is damaged")) << left;
  }
}

/// Spoils four bytes of a file.
void damage(const fs::path& file, std::uint64_t position) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(position));
  stream << "dama";
}

TEST_F(Records, DamagedDataAreRefused) {
  for (const char* path : {"/sim/positions", "/observation/coverage", "/params/k_u"}) {
    write_example();
    haddr_t address = 0;
    hsize_t bytes = 0;
    change([&](hid_t file) {
      const hid_t data = H5Dopen2(file, path, H5P_DEFAULT);
      const hid_t space = H5Dget_space(data);
      hsize_t offset[3];
      unsigned mask = 0;
      ASSERT_GE(H5Dget_chunk_info(data, space, 0, offset, &mask, &address, &bytes), 0);
      H5Sclose(space);
      H5Dclose(data);
    });
    damage(file_, address + bytes / 2);
    EXPECT_TRUE(contains(error(), std::string("dataset ") + path + " cannot be read"));
  }
}

TEST_F(Records, DamagedMetadataAreRefused) {
  write_example();
  std::ifstream stream(file_, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::string signature = "OHDR";  // opens the header of a group or dataset
  int headers = 0;
  for (size_t at = bytes.find(signature); at != std::string::npos;
       at = bytes.find(signature, at + 1)) {
    if (headers++ % 8 != 0) continue;
    write_example();
    damage(file_, at + 20);
    EXPECT_TRUE(holds_in_child([this] { return !error().empty(); })) << "object header at " << at;
  }
  EXPECT_GT(headers, 40);  // there is one a column
}

TEST_F(Records, TheLibraryStaysSilent) {
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(error().empty());
  std::ofstream(file_) << "not HDF5";
  EXPECT_FALSE(error().empty());
  write_example();
  change([](hid_t file) { H5Ldelete(file, "/params", H5P_DEFAULT); });
  EXPECT_FALSE(error().empty());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace drape
