// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/evaluation/localization_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace vmcl {
namespace {

namespace fs = std::filesystem;

/// A folder that is the only place where programs are looked for.
class PictureTest : public testing::Test {
 protected:
  PictureTest() : path_(std::getenv("PATH")) {
    std::string name = fs::temp_directory_path() / "vmcl-picture-XXXXXX";
    folder_ = mkdtemp(name.data());
    setenv("PATH", folder_.c_str(), 1);
    LocalizationFrame frame;
    frame.localized = true;
    run_.frames = {frame};
  }
  ~PictureTest() override {
    setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }

  void makeGnuplot(const std::string& script) const {
    std::ofstream(folder_ / "gnuplot") << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / "gnuplot", fs::perms::owner_all);
  }

  void expectFailure(const std::string& why) const {
    EXPECT_THAT([&] { drawPath(folder_ / "path", run_, {}); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::AllOf(testing::HasSubstr((folder_ / "path.svg").string()), testing::HasSubstr(why))));
    EXPECT_FALSE(fs::exists(folder_ / "path.svg"));
  }

  std::string path_;
  fs::path folder_;
  LocalizationRun run_;
};

TEST_F(PictureTest, SaysWhatGnuplotSaid) {
  makeGnuplot("echo 'unknown terminal type pngcairo' >&2\nexit 1\n");
  expectFailure("unknown terminal type pngcairo");
}

TEST_F(PictureTest, SaysThatGnuplotIsMissing) { expectFailure("installed"); }

}  // namespace
}  // namespace vmcl
