#include <gtest/gtest.h>

#include <fstream>

#include "core/sha256.h"
#include "tests/support/records_fixture.h"

namespace drape {
namespace {

// The examples of FIPS 180-4, and what sha256sum says of one that fills blocks exactly.
TEST(Sha256, IsTheStandards) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

using Sha256OfFile = test::Records;  // for its folder

TEST_F(Sha256OfFile, TellsAChangedByte) {
  const auto write = [this](const std::string& text) { std::ofstream(file_) << text; };
  write("abc");
  EXPECT_EQ(verify_checksum(file_), ChecksumState::missing);
  write_checksum(file_);
  EXPECT_EQ(verify_checksum(file_), ChecksumState::matches);
  write("abd");
  EXPECT_EQ(verify_checksum(file_), ChecksumState::differs);
  std::ofstream(checksum_file(file_)) << "";
  EXPECT_EQ(verify_checksum(file_), ChecksumState::differs);
  EXPECT_THROW(sha256_of_file(folder_ / "missing"), std::filesystem::filesystem_error);
}

}  // namespace
}  // namespace drape
