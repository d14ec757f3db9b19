// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/atomic_file.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

namespace vmcl {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::temp_directory_path() / (std::string("vmcl_atomic_") + test->name());
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }
  auto fileCount() const { return std::distance(fs::directory_iterator(directory_), {}); }

  fs::path directory_;
};

TEST_F(AtomicFileTest, AppearsWholeOnCommit) {
  const fs::path file = directory_ / "f";
  std::ofstream(file) << "old";
  AtomicFile out(file);
  out.stream() << "new";
  EXPECT_EQ(contentOf(file), "old");
  out.commit();
  EXPECT_EQ(contentOf(file), "new");
  EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  { AtomicFile(directory_ / "f").stream() << "half"; }
  EXPECT_EQ(fileCount(), 0);
}

TEST_F(AtomicFileTest, NamesTheFileItCannotWrite) {
  try {
    AtomicFile out(directory_ / "absent" / "f");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find((directory_ / "absent" / "f").string()), std::string::npos);
  }
}

TEST_F(AtomicFileTest, FullDiskLeavesTheOldFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const fs::path file = directory_ / "f";
  std::ofstream(file) << "old";
  AtomicFile out(file);
  fs::remove(out.temporaryPath());
  fs::create_symlink("/dev/full", out.temporaryPath());
  static_cast<std::ofstream&>(out.stream()).close();
  static_cast<std::ofstream&>(out.stream()).open(out.temporaryPath());
  out.stream() << "new";
  EXPECT_THROW(out.commit(), std::runtime_error);
  EXPECT_EQ(contentOf(file), "old");
}

}  // namespace
}  // namespace vmcl
