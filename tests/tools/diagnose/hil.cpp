// The loop closed: what the real-time server logs along a held-out recording, with the nominal axis and the updated one.

#include "tools/diagnose/hil.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/made_case.h"
#include "tests/support/shared_data.h"
#include "tools/diagnose/diagnosis.h"

namespace feedtwin {
namespace {

using tools::diagnosis::run_hil;

TEST(Hil, TheServerComesCloserToTheRecordingWithTheUpdatedAxis) {
  auto truth = plant::source_axis();
  truth.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", 0.02}, {"cycles_per_rev", 8.0}}));
  auto data = tests::short_case(truth, plant::source_axis());
  const auto found = run_hil({data, plant::source_axis(), truth, 0.8}, [](std::string_view) {});
  EXPECT_EQ(found.before.ticks, 800U);
  EXPECT_EQ(found.after.ticks, 800U);
  EXPECT_GT(found.before.nrmse.at("torque_cmd_Nm"), 0.05);
  EXPECT_LT(found.after.nrmse.at("torque_cmd_Nm"), 0.2 * found.before.nrmse.at("torque_cmd_Nm"));

  data.holdout.clear();
  EXPECT_NE(tests::complaint_of([&] { (void)run_hil({data, truth, truth, 0.1}, [](std::string_view) {}); }).find("holdout"),
            std::string::npos);
}

// Half a minute: tests/run --all.
TEST(Hil, APracticeCase) {
  if (std::getenv("FEEDTWIN_ALL_TESTS") == nullptr) GTEST_SKIP() << "FEEDTWIN_ALL_TESTS is not set";
  FEEDTWIN_NEEDS_SHARED("practice/p03");
  const auto data = tools::read_case(tests::shared_path("practice/p03"));
  const auto found = tools::diagnosis::diagnose(data, [](std::string_view) {});
  const auto hil = run_hil({data, data.axis, found.updated, 3.0}, [](std::string_view) {});
  EXPECT_LT(hil.after.nrmse.at("torque_cmd_Nm"), 0.1 * hil.before.nrmse.at("torque_cmd_Nm"));
}

}  // namespace
}  // namespace feedtwin
