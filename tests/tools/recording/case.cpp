#include "tools/recording/case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/made_case.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"
#include "tools/recording/checks.h"

namespace feedtwin::tools {
namespace {

using tests::complaint_of;

constexpr const char* plain = "axis = \"axis.toml\"\nfit = [\"run.csv\"]\nsample_rate_Hz = 1000\n";

class CaseFolder : public testing::Test {
 protected:
  CaseFolder() {
    write_axis_file(folder / "axis.toml", plant::source_axis());
    run_ = tests::make_recording(plant::source_axis(),
                                 {.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.06}, .duration_s = 1.0});
    write_whole_file(folder / "case.toml", plain);
  }
  /// What reading the case says once the run has been changed.
  std::string after(const std::function<void(Recording&)>& change) {
    Recording changed = run_;
    change(changed);
    write_recording(folder / "run.csv", changed);
    return complaint_of([this] { static_cast<void>(read_case(folder.path())); });
  }
  std::vector<double>& of(Recording& recording, const char* name) { return recording.channels.at(name); }

  tests::ScratchFolder folder{"case"};
  Recording run_;
};

TEST_F(CaseFolder, ReadsWhatWasWritten) {
  ASSERT_EQ(after([](Recording&) {}), "");
  const Case read = read_case(folder.path());
  ASSERT_EQ(read.fit.size(), 1U);
  EXPECT_EQ(read.fit[0].channels, run_.channels);
  EXPECT_EQ(read.fit[0].sample_s, 1e-3);
  EXPECT_EQ(read.axis.guide_mass_kg, plant::source_axis().guide_mass_kg);
  EXPECT_TRUE(read.holdout.empty());
  EXPECT_FALSE(read.controller.has_value());
  EXPECT_EQ(read.remarks, std::vector<std::string>{});
}

TEST_F(CaseFolder, TakesItsOwnControllerAndLeavesAnotherToTheStandIn) {
  const auto with = [this](const std::string& controller) {
    write_whole_file(folder / "case.toml", std::string(plain) + "[controller]\n" + controller);
    EXPECT_EQ(after([](Recording& r) { r.channels["reference_m"] = r.channels.at("position_m"); }), "") << controller;
    return read_case(folder.path());
  };
  const Case own = with("type = \"cascade\"\nsample_rate_Hz = 1000\nposition_per_s = 50\nvelocity_Ns_per_m = 9000\n");
  ASSERT_TRUE(own.controller.has_value());
  EXPECT_EQ(own.controller->position_per_s, 50.0);
  EXPECT_TRUE(own.remarks.empty());
  for (const auto& [foreign, named] :
       {std::pair{"type = \"state space\"\n[controller.a]\nrows = [1, 2]\n", "type 'state space'"},
        {"position_per_s = 50\nvelocity_Ns_per_m = 9000\nkv = 3\n", "key 'kv'"},
        {"position_per_s = 50\nvelocity_Ns_per_m = 9000\nsample_rate_Hz = 4000\n", "rate"}}) {
    const Case other = with(foreign);
    EXPECT_FALSE(other.controller.has_value()) << foreign;
    ASSERT_EQ(other.remarks.size(), 1U) << foreign;
    EXPECT_NE(other.remarks[0].find(named), std::string::npos) << other.remarks[0];
  }
  write_whole_file(folder / "case.toml", std::string(plain) + "[controller]\nposition_per_s = \"fast\"\n");
  EXPECT_NE(complaint_of([this] { static_cast<void>(read_case(folder.path())); }).find("controller.position_per_s"),
            std::string::npos);
}

TEST_F(CaseFolder, MapsForeignNamesAndUnits) {
  Recording foreign;
  foreign.channels = {};
  std::vector<double> volts = run_.channels.at("torque_cmd_Nm");
  for (double& v : volts) v = (v - 0.25) / 0.5;
  std::string text = "t,vir,qm\n";
  for (std::size_t i = 0; i < volts.size(); ++i) {
    text += std::to_string(static_cast<double>(i) * 1e-3) + "," + std::to_string(volts[i]) + "," +
            std::to_string(1e3 * run_.at("position_m")[i]) + "\n";
  }
  write_whole_file(folder / "run.csv", text);
  write_whole_file(folder / "case.toml",
                   std::string(plain) +
                       "[channels]\ntime_s = { column = \"t\" }\ntorque_cmd_Nm = { column = \"vir\", scale = 0.5, "
                       "offset = 0.25 }\nposition_m = { column = \"qm\", scale = 1e-3 }\n");
  const Case read = read_case(folder / "case.toml");
  for (std::size_t i = 0; i < volts.size(); ++i) {
    ASSERT_NEAR(read.fit[0].at("torque_cmd_Nm")[i], run_.at("torque_cmd_Nm")[i], 1e-6) << i;
    ASSERT_NEAR(read.fit[0].at("position_m")[i], run_.at("position_m")[i], 1e-9) << i;
  }
}

TEST_F(CaseFolder, ForceAndScaleStandForTorqueAndEncoder) {
  ASSERT_EQ(after([this](Recording& r) {
              auto force = of(r, "torque_cmd_Nm");
              for (double& v : force) v *= 2.0 * 3.14159265358979323846 / 0.005;
              r.channels["force_cmd_N"] = force;
              r.channels.erase("torque_cmd_Nm");
              r.channels.erase("position_m");
            }),
            "");
  const Case read = read_case(folder.path());
  EXPECT_NEAR(read.fit[0].at("torque_cmd_Nm")[500], run_.at("torque_cmd_Nm")[500], 1e-12);
  EXPECT_EQ(read.fit[0].at("position_m")[500], run_.at("scale_position_m")[500]);
}

TEST_F(CaseFolder, RefusesBadTime) {
  EXPECT_NE(after([this](Recording& r) {
              std::swap(of(r, "time_s")[10], of(r, "time_s")[11]);
            }).find("run.csv:13:1: time_s: 0.01 s comes after a later time"),
            std::string::npos);
  EXPECT_NE(after([this](Recording& r) { of(r, "time_s")[10] = of(r, "time_s")[9]; }).find("run.csv:12:1: time_s: 0.009"),
            std::string::npos);
  EXPECT_NE(after([](Recording& r) {
              for (auto& [name, values] : r.channels) values.erase(values.begin() + 500, values.begin() + 510);
            }).find("run.csv:502:1: time_s: a step of 11 ms after 0.499 s; expected 1 ms"),
            std::string::npos);
  EXPECT_NE(after([this](Recording& r) {
              for (double& t : of(r, "time_s")) t *= 1e3;
            }).find("is the time in ms?"),
            std::string::npos);
  EXPECT_NE(after([this](Recording& r) {
              for (double& t : of(r, "time_s")) t *= 2;
            }).find("steps of 0.002 s, but 1000 Hz is stated"),
            std::string::npos);
  EXPECT_NE(after([](Recording& r) {
              for (auto& [name, values] : r.channels) values.resize(150);
            }).find("holds 150 samples; at least 200 are needed"),
            std::string::npos);
}

TEST_F(CaseFolder, RefusesDeadAndMissingChannels) {
  for (const char* name : {"torque_cmd_Nm", "position_m", "force_sensor_N", "power_W"}) {
    const std::string said = after([&](Recording& r) { std::ranges::fill(of(r, name), 0.25); });
    EXPECT_NE(said.find(std::string(name) + ": constant at 0.25 over 1000 samples"), std::string::npos) << said;
  }
  EXPECT_NE(after([](Recording& r) { r.channels.erase("time_s"); }).find("no time_s channel"), std::string::npos);
  EXPECT_NE(after([](Recording& r) { r.channels.erase("torque_cmd_Nm"); }).find("no torque_cmd_Nm or force_cmd_N channel"),
            std::string::npos);
  EXPECT_NE(after([](Recording& r) {
              r.channels.erase("position_m");
              r.channels.erase("scale_position_m");
            }).find("no position_m or scale_position_m channel"),
            std::string::npos);
}

TEST_F(CaseFolder, RefusesUnitsWrongByAThousandEitherWay) {
  for (const char* name :
       {"torque_cmd_Nm", "position_m", "scale_position_m", "torque_sensor_Nm", "force_sensor_N", "power_W", "reference_m"}) {
    for (const double factor : {1e3, 1e-3}) {
      const std::string said = after([&](Recording& r) {
        for (double& v : of(r, name)) v *= factor;
      });
      EXPECT_NE(said.find("units?"), std::string::npos) << name << " times " << factor << ": " << said;
      // a wrong motor position shows against the scale first: either name will do
      const bool named = said.find(std::string(name) + ":") != std::string::npos;
      EXPECT_TRUE(named || std::string(name) == "position_m") << said;
    }
  }
}

TEST_F(CaseFolder, WrongUnitsShowWithoutSensorsToo) {
  for (const char* name : {"torque_cmd_Nm", "position_m"}) {
    for (const double factor : {1e3, 1e-3}) {
      const std::string said = after([&](Recording& r) {
        for (const char* sensor : {"scale_position_m", "torque_sensor_Nm", "force_sensor_N", "power_W", "reference_m"})
          r.channels.erase(sensor);
        for (double& v : of(r, name)) v *= factor;
      });
      EXPECT_NE(said.find(std::string(name) + ":"), std::string::npos) << name << " times " << factor << ": " << said;
    }
  }
}

// With a wrong lead, or a load that pulls, the command's share along the sign of the speed may be next to nothing.
TEST_F(CaseFolder, FrictionThatIsNotAsTheFileHasItIsNoWrongUnit) {
  for (int i = 0; i <= 160; ++i) {
    const std::string said = after([&](Recording& r) {
      r.channels.erase("power_W");  // still that of the whole friction
      const auto& position_m = of(r, "position_m");
      for (std::size_t k = 1; k < position_m.size(); ++k) {
        const double moved_m = position_m[k] - position_m[k - 1];
        of(r, "torque_cmd_Nm")[k] -= 1e-3 * i * (moved_m > 0.0 ? 1.0 : moved_m < 0.0 ? -1.0 : 0.0);
      }
    });
    EXPECT_EQ(said, "") << i << " mN m less friction";
  }
}

TEST_F(CaseFolder, RefusesABadCaseFile) {
  const auto says = [this](const std::string& text) {
    write_whole_file(folder / "case.toml", text);
    return complaint_of([this] { static_cast<void>(read_case(folder.path())); });
  };
  ASSERT_EQ(after([](Recording&) {}), "");
  EXPECT_NE(says("fit = [\"run.csv\"]\nsample_rate_Hz = 1000\n").find("case.toml: axis: missing"), std::string::npos);
  EXPECT_NE(says("axis = \"axis.toml\"\nsample_rate_Hz = 1000\n").find("case.toml: fit: missing"), std::string::npos);
  EXPECT_NE(says("axis = \"axis.toml\"\nfit = [\"run.csv\"]\n").find("sample_rate_Hz: missing"), std::string::npos);
  EXPECT_NE(says(std::string(plain) + "holdout = [\"run.csv\"]\n").find("case.toml:4: holdout: 'run.csv' is in fit too"),
            std::string::npos);
  EXPECT_NE(says(std::string(plain) + "holdouts = [\"run.csv\"]\n").find("case.toml:4: holdouts: unknown key"),
            std::string::npos);
  EXPECT_NE(says(std::string(plain) + "[channels]\nspeed = { column = \"v\" }\n")
                .find("case.toml:5: channels.speed: unknown channel"),
            std::string::npos);
  EXPECT_NE(says(std::string(plain) + "[channels]\npower_W = { column = \"p\" }\n")
                .find("run.csv: power_W: no column 'p'; found time_s"),
            std::string::npos);
  EXPECT_NE(says("axis = \"axis.toml\"\nfit = [\"none.csv\"]\nsample_rate_Hz = 1000\n").find("none.csv: cannot be opened"),
            std::string::npos);
  EXPECT_NE(says("axis = \"axis.toml\"\nfit = [\"run.txt\"]\nsample_rate_Hz = 1000\n").find("ends in .csv or .mat"),
            std::string::npos);
}

TEST(ChannelQuality, FindsTheGridAndSaturation) {
  std::mt19937 random(5);
  std::normal_distribution<double> unit;
  std::vector<double> smooth, gridded, clipped;
  for (int i = 0; i < 5000; ++i) {
    const double value = 3.0 * unit(random);
    smooth.push_back(value);
    gridded.push_back(0.25 * std::round(value / 0.25));
    clipped.push_back(std::clamp(value, -3.0, 3.0));
  }
  EXPECT_EQ(channel_quality(smooth).resolution, 0.0);
  EXPECT_NEAR(channel_quality(gridded).resolution, 0.25, 1e-12);
  EXPECT_LT(channel_quality(smooth).saturated_share, 0.001);
  EXPECT_NEAR(channel_quality(clipped).saturated_share, 0.317, 0.02);
}

TEST(ChannelQuality, OneSpeedForthAndBackIsNoGrid) {
  std::vector<double> position;
  double at = 0.0;
  for (int i = 0; i < 8000; ++i) {  // steps of 0.0185 but where it turns, every second
    const int since = i % 1000;
    const double speed = 0.0185 * std::min({1.0, (since + 0.5) / 20.0, (1000.0 - since) / 20.0});
    position.push_back(at += i / 1000 % 2 == 0 ? speed : -speed);
  }
  EXPECT_EQ(channel_quality(position).resolution, 0.0);
}

}  // namespace
}  // namespace feedtwin::tools
