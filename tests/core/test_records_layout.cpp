// The names, shapes and storage on disk that other programs rely on.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "tests/support/records_fixture.h"

namespace drape {
namespace {

using namespace test;

// The names that other programs rely on, checked without the code under test.
TEST_F(Records, LayoutOnDisk) {
  std::vector<Record> records{make_record(0, header_), make_record(1, header_)};
  records[0].observation.coverage(0, 0) = 1;  // row 0 comes first on disk
  records[0].estimate = make_estimate(0, header_);
  write_records(file_, header_, records);
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto shape = [file](const std::string& path) {
    std::vector<hsize_t> sizes(4, 0);
    const hid_t data = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    EXPECT_GE(data, 0) << path;
    const hid_t space = H5Dget_space(data);
    sizes.resize(static_cast<size_t>(H5Sget_simple_extent_dims(space, sizes.data(), nullptr)));
    H5Sclose(space);
    H5Dclose(data);
    return sizes;
  };
  using Sizes = std::vector<hsize_t>;
  EXPECT_EQ(shape("/mesh/disc_7/rest_uv"), (Sizes{7, 2}));
  EXPECT_EQ(shape("/mesh/disc_7/triangles"), (Sizes{6, 3}));
  EXPECT_EQ(shape("/mesh/disc_7/fixed"), (Sizes{7}));
  for (const char* group : {"/params/", "/params_estimated/", "/params_estimated_log_sd/",
                            "/params_estimated_picture_share/"})
    for (Parameter p : all_parameters())
      EXPECT_EQ(shape(group + std::string(name(p))), (Sizes{2})) << name(p);
  for (const char* path :
       {"/fabric/id", "/fabric/name", "/fabric/category", "/fabric/subcategory", "/fabric/type",
        "/fabric/composition", "/stats/status", "/stats/protocol", "/stats/residual_relative",
        "/stats/newton_iterations", "/stats/negative_eigenvalues", "/stats/cpu_seconds",
        "/observation/drape_coefficient", "/observation/node_count"})
    EXPECT_EQ(shape(path), (Sizes{2})) << path;
  EXPECT_EQ(shape("/sim/positions"), (Sizes{2, 7, 3}));
  EXPECT_EQ(shape("/sim_estimated/positions"), (Sizes{2, 7, 3}));
  EXPECT_EQ(shape("/estimate/effective_rigidity"), (Sizes{2, 3}));
  EXPECT_EQ(shape("/estimate/effective_rigidity_log_sd"), (Sizes{2, 3}));
  EXPECT_EQ(shape("/observation/profile"), (Sizes{2, 360}));
  EXPECT_EQ(shape("/observation/coverage"), (Sizes{2, 5, 8}));
  for (const char* attribute : {"schema", "version", "config", "seed", "git_commit", "compiler",
                                "gravity", "bending_law", "bending_threshold"})
    EXPECT_GT(H5Aexists(file, attribute), 0) << attribute;
  EXPECT_GT(H5Aexists_by_name(file, "/sim", "mesh", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/mesh/disc_7", "clamp_wing_factor", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/observation/coverage", "pixel_size_m", H5P_DEFAULT), 0);
  EXPECT_GT(H5Aexists_by_name(file, "/observation/coverage", "origin_m", H5P_DEFAULT), 0);

  std::vector<double> positions(2 * 7 * 3);
  const hid_t sim = H5Dopen2(file, "/sim/positions", H5P_DEFAULT);
  H5Dread(sim, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, positions.data());
  EXPECT_EQ(positions[21 + 3 * 5 + 2], position(records[1].positions, 5).z());
  const hid_t storage = H5Dget_create_plist(sim);
  hsize_t chunk[3] = {0, 0, 0};
  ASSERT_EQ(H5Pget_chunk(storage, 3, chunk), 3);
  EXPECT_EQ(chunk[0], 1u);
  EXPECT_EQ(chunk[1], 7u);
  EXPECT_EQ(H5Pget_nfilters(storage), 3);  // shuffle, gzip, check sum
  H5Pclose(storage);
  H5Dclose(sim);

  std::vector<std::uint16_t> coverage(2 * 5 * 8);
  const hid_t image = H5Dopen2(file, "/observation/coverage", H5P_DEFAULT);
  H5Dread(image, H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, coverage.data());
  EXPECT_EQ(coverage[0], 65535);
  EXPECT_EQ(coverage[8 + 3], std::lround(65535 * records[0].observation.coverage(1, 3)));
  H5Dclose(image);
  H5Fclose(file);
}

TEST_F(Records, WithoutEstimatesTheirGroupsAreLeftOut) {
  write_example();
  change([](hid_t file) {
    for (const char* group : {"estimate", "params_estimated", "params_estimated_log_sd",
                              "params_start", "sim_estimated", "stats_estimated"})
      EXPECT_EQ(H5Lexists(file, group, H5P_DEFAULT), 0) << group;
  });
}

}  // namespace
}  // namespace drape
