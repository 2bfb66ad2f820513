// The readers on recordings that others made: practice cases and a real axis, where they are at hand.

#include <gtest/gtest.h>

#include "tests/support/made_case.h"
#include "tests/support/shared_data.h"
#include "tools/config/axis_file.h"
#include "tools/config/whole_file.h"
#include "tools/recording/case.h"

namespace feedtwin::tools {
namespace {

TEST(PracticeCases, AreReadWithoutComplaint) {
  FEEDTWIN_NEEDS_SHARED("practice");
  for (int i = 1; i <= 10; ++i) {
    const auto read = read_case(tests::shared_path(std::string("practice/p") + (i < 10 ? "0" : "") + std::to_string(i)));
    EXPECT_EQ(read.fit.size(), 3U);
    EXPECT_EQ(read.holdout.size(), 1U);
    EXPECT_EQ(read.remarks, std::vector<std::string>{}) << i;
  }
}

TEST(EmpsRecord, IsReadThroughAChannelMap) {
  FEEDTWIN_NEEDS_SHARED("data/DATA_EMPS.mat");
  tests::ScratchFolder folder("emps");
  auto axis = plant::source_axis();
  axis.axis.lead_m = 0.0025;
  axis.axis.stroke_m = 0.6;
  axis.axis.encoder_counts_per_rev = 50000;
  write_axis_file(folder / "axis.toml", axis);
  const std::string record = tests::shared_path("data/DATA_EMPS.mat");
  write_whole_file(folder / "case.toml", "axis = \"axis.toml\"\nfit = [\"" + record +
                                             "\"]\nsample_rate_Hz = 1000\n[channels]\ntime_s = { column = \"t\" }\n"
                                             "force_cmd_N = { column = \"vir\", scale = 35.150651882723 }\n"
                                             "position_m = { column = \"qm\" }\nreference_m = { column = \"qg\" }\n");
  const auto read = read_case(folder.path());
  ASSERT_EQ(read.fit.size(), 1U);
  EXPECT_EQ(read.fit[0].size(), 24841U);
  EXPECT_NEAR(read.fit[0].at("force_cmd_N")[0], 2.53862809 * 35.150651882723, 1e-6);
}

}  // namespace
}  // namespace feedtwin::tools
