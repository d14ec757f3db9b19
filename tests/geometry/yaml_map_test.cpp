// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/geometry/yaml_map.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch_directory.h"

namespace vmcl {
namespace {

class YamlMapTest : public testing::Test {
 protected:
  YamlMap read(const std::string& text) const {
    std::ofstream(file()) << text;
    return YamlMap::read(file());
  }
  std::filesystem::path file() const { return scratch_.path() / "file.yaml"; }

  template <class Action>
  void expectFailure(Action&& action, const std::string& message) const {
    try {
      action();
      ADD_FAILURE() << "no failure, expected " << message;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), file().string() + message);
    }
  }

  ScratchDirectory scratch_;
};

TEST_F(YamlMapTest, readsValuesMapsAndLists) {
  YamlMap yaml = read("a: 1.5\nb: {c: text}\nd: [{e: 1}, {e: 2}]\nf: [1, 2]\ng: [h, i]\nk: [[1], [2, 3]]\n");
  EXPECT_EQ(yaml.get<double>("a"), 1.5);
  EXPECT_EQ(yaml.get("z", 7), 7);
  EXPECT_EQ(yaml.map("b").get<std::string>("c"), "text");
  EXPECT_EQ(yaml.list("d").at(1).get<int>("e"), 2);
  EXPECT_TRUE(yaml.list("none").empty());
  EXPECT_EQ(yaml.numbers("f", 2), (std::vector<double>{1, 2}));
  EXPECT_EQ(yaml.texts("g"), (std::vector<std::string>{"h", "i"}));
  EXPECT_EQ(yaml.rows("k", 1, 2), (std::vector<std::vector<double>>{{1}, {2, 3}}));
  EXPECT_EQ(yaml.within("a", 0, 1, 2), 1.5);
  EXPECT_EQ(yaml.directory(), scratch_.path());
  EXPECT_NO_THROW(yaml.finish());
}

TEST_F(YamlMapTest, namesFileLineAndKey) {
  YamlMap yaml = read("a: text\nb:\n  c: .nan\n  d: 1\nlist: [{e: 1}]\n");
  YamlMap b = yaml.map("b");
  YamlMap item = yaml.list("list").at(0);
  expectFailure([&] { yaml.get<double>("a"); }, ":1: a has an unfit value");
  expectFailure([&] { b.get<double>("c"); }, ":3: b.c is not finite");
  expectFailure([&] { b.finish(); }, ":4: b.d is not a known key");
  expectFailure([&] { yaml.map("a"); }, ":1: a is not a mapping of keys to values");
  expectFailure([&] { yaml.get<int>("z"); }, ":1: z is missing");
  expectFailure([&] { item.get<double>("f"); }, ":5: list[0].f is missing");
  expectFailure([&] { yaml.texts("a"); }, ":1: a is not a list");
  expectFailure([&] { yaml.texts("list"); }, ":5: list has an unfit value");
  expectFailure([&] { b.within("d", 0, 2, 3); }, ":4: b.d is not between 2.000000 and 3.000000");
  expectFailure([&] { yaml.rows("list", 1, 2); }, ":5: list is not a list of lists of 1 to 2 numbers");
  expectFailure([&] { yaml.numbers("list", 3); }, ":5: list is not a list of 3 numbers");
}

TEST_F(YamlMapTest, refusesWhatIsNoMapping) {
  expectFailure([&] { read(""); }, ": the file is not a mapping of keys to values");
  expectFailure([&] { read("- 1\n"); }, ":1: the file is not a mapping of keys to values");
  EXPECT_THROW(read("a: [1, 2"), std::runtime_error);
  EXPECT_THROW(read(std::string(5 << 20, ' ')), std::runtime_error);
  EXPECT_THROW(YamlMap::read(scratch_.path()), std::runtime_error);
}

}  // namespace
}  // namespace vmcl
