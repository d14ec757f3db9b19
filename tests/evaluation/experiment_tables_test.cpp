// SPDX-License-Identifier: BSD-3-Clause
#include "experiment_tables.h"

#include <gtest/gtest.h>

namespace vmcl {
namespace {

TEST(ExperimentTables, TitlesTellStartsApart) {
  ExperimentResults results;
  results.experiment.sessions.emplace_back().name = "query";
  results.experiment.starts = {{"global-after-3s", false, std::nullopt, 3},
                               {"kidnapped", true, Kidnapping{2, 1.5}, 0},
                               {"kidnapped later", true, Kidnapping{2, 1.5}, 0.5}};
  EXPECT_EQ(titleOf(results, {0, 0, {}}), "query, global-after-3s start");
  EXPECT_EQ(titleOf(results, {0, 1, {}}), "query, kidnapped at 2 s for 1.5 s");
  EXPECT_EQ(titleOf(results, {0, 2, {}}), "query, kidnapped at 2 s for 1.5 s, started after 0.5 s");
}

}  // namespace
}  // namespace vmcl
