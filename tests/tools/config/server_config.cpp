#include "tools/config/server_config.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "io/faults/fault_port.h"
#include "plant/parameter_table.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

namespace fs = std::filesystem;

class ServerConfigFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("feedtwin-config-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string write(const std::string& text) const {
    const auto path = (folder_ / "server.toml").string();
    write_whole_file(path, text);
    return path;
  }
  /// The source's axis as text, with one line changed by `edit` (key without its table).
  [[nodiscard]] static std::string axis_text(std::string_view key,
                                             const std::function<std::string(const std::string&)>& edit) {
    const auto path = fs::temp_directory_path() / ("feedtwin-axis-" + std::to_string(::getpid()) + ".toml");
    write_axis_file(path.string(), plant::source_axis());
    const std::string text = read_whole_file(path.string());
    fs::remove(path);
    std::string table, out;
    std::size_t begin = 0;
    while (begin < text.size()) {
      const std::size_t end = text.find('\n', begin);
      std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      if (line.starts_with("[")) table = line.substr(1, line.size() - 2);
      const std::string name = table + "." + line.substr(0, line.find(' '));
      out += (name == key ? edit(line) : line) + "\n";
    }
    return out;
  }
  /// The message that reading this text ends with; empty if it is accepted.
  [[nodiscard]] std::string error_of(const std::string& text) const {
    try {
      (void)read_server_config({.path = write(text), .with_ports = false});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

std::string set(const std::string& line, const std::string& value) {
  return line.substr(0, line.find('=')) + "= " + value;
}

TEST_F(ServerConfigFile, EveryAxisKeyMissingUnknownWrongTypeOutOfRangeNotFinite) {
  for (const auto& entry : plant::parameter_table()) {
    const std::string key(entry.key);
    const auto with = [&](const std::string& value) {
      return error_of(axis_text(key, [&](const std::string& line) { return set(line, value); }));
    };
    const auto missing = error_of(axis_text(key, [](const std::string&) { return std::string(); }));
    if (entry.preset) {
      EXPECT_EQ(missing, "") << key << " is optional";
    } else {
      EXPECT_NE(missing.find(key + ": missing"), std::string::npos) << missing;
    }
    for (const std::string value : {"\"heavy\"", "true", "[1.0]", "nan", "inf", "-inf", "1e300", "-1e300"}) {
      const auto message = with(value);
      EXPECT_NE(message.find("server.toml:"), std::string::npos) << key << " = " << value << " gave: " << message;
      EXPECT_NE(message.find(key + ": expected"), std::string::npos) << key << " = " << value << " gave: " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
    }
    const auto unknown = error_of(axis_text(key, [](const std::string& line) { return line + "\nmisspelt_N = 1"; }));
    EXPECT_NE(unknown.find("misspelt_N: unknown key"), std::string::npos) << unknown;
  }
}

TEST_F(ServerConfigFile, EveryServerKeyWrongTypeOutOfRange) {
  struct Key {
    const char *table, *key, *out_of_range;
  };
  const Key keys[] = {
      {"server", "period_s", "0.0"},
      {"server", "watchdog_s", "-1.0"},
      {"server", "late_us", "0.0"},
      {"server", "overrun", "\"sometimes\""},
      {"server", "pace", "\"slow\""},
      {"server", "lockstep_timeout_s", "1e9"},
      {"server", "controller", "\"nobody\""},
      {"server", "priority", "100"},
      {"server", "cpu", "-2"},
      {"server", "axes", "[\"not-there.toml\"]"},
      {"loopback", "motion", "\"waltz\""},
      {"loopback", "amplitude_m", "0.0"},
      {"loopback", "speed_m_per_s", "-1.0"},
      {"loopback", "acceleration_m_per_s2", "nan"},
      {"loopback", "jerk_m_per_s3", "inf"},
      {"loopback", "dwell_s", "-0.1"},
      {"loopback", "position_per_s", "-1.0"},
      {"loopback", "velocity_Ns_per_m", "-1.0"},
      {"loopback", "velocity_integral_N_per_m", "-1.0"},
      {"loopback", "velocity_feedforward", "3.0"},
      {"loopback", "acceleration_feedforward_kg", "-1.0"},
      {"loopback", "current_loop_time_constant_s", "2.0"},
  };
  for (const auto& k : keys) {
    for (const std::string& value : {std::string(k.out_of_range), std::string("{}"), std::string("1979-05-27")}) {
      const auto message = error_of("[" + std::string(k.table) + "]\n" + k.key + " = " + value + "\n");
      EXPECT_NE(message, "") << k.table << "." << k.key << " = " << value << " was accepted";
      if (value != k.out_of_range) {
        EXPECT_NE(message.find(std::string(k.table) + "." + k.key), std::string::npos) << message;
      }
    }
  }
  for (const std::string line : {"real_time = 1", "lock_memory = \"yes\"", "hold_cpu_latency = 0"}) {
    EXPECT_NE(error_of("[server]\n" + line).find("expected true or false"), std::string::npos) << line;
  }
}

TEST_F(ServerConfigFile, WhatIsNotTomlOrNotThere) {
  EXPECT_NE(error_of("[server\nperiod_s = 1").find("not valid TOML"), std::string::npos);
  EXPECT_NE(error_of("[[port]]\nkind = \"pigeon\"").find("port[0].kind: expected one of"), std::string::npos);
  EXPECT_NE(error_of("[[port]]\n").find("kind is missing"), std::string::npos);
  EXPECT_NE(error_of("[servr]\nperiod_s = 1.0").find("servr.period_s: unknown key"), std::string::npos);
  EXPECT_NE(error_of("server = 3").find("server: unknown key"), std::string::npos) << "a value where a table should be";
  EXPECT_NE(error_of("[nothing]").find("nothing: unknown key"), std::string::npos);
  EXPECT_EQ(error_of("[server]"), "");
  EXPECT_THROW((void)read_server_config({.path = (folder_ / "nothing.toml").string()}), InputError);
  EXPECT_THROW((void)read_server_config({.path = folder_.string()}), InputError);
  EXPECT_THROW((void)read_server_config({.path = "", .controller = "pigeon"}), InputError);
}

TEST_F(ServerConfigFile, EverySampleConfigurationIsAccepted) {
  int samples = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(FEEDTWIN_SOURCE_DIR) / "systemd")) {
    if (entry.path().extension() != ".toml") continue;
    ++samples;
    EXPECT_NO_THROW((void)read_server_config({.path = entry.path().string()})) << entry.path();
  }
  EXPECT_GE(samples, 1);
}

TEST_F(ServerConfigFile, WithoutAFileItIsTheSourcesAxis) {
  const auto config = read_server_config({.path = "", .with_ports = false});
  ASSERT_EQ(config.axes.size(), 1U);
  EXPECT_EQ(config.controller, "modbus");
  EXPECT_EQ(config.loop.tick_s, 1e-3);
  auto expected = plant::source_axis();
  auto read = config.axes[0];
  for (const auto& entry : plant::parameter_table()) EXPECT_EQ(entry.in(read), entry.in(expected)) << entry.key;
}

TEST_F(ServerConfigFile, AnAxisFileWrittenAndReadIsTheSame) {
  auto axis = plant::source_axis();
  axis.guide_mass_kg = 4.0 / 3.0;
  const auto path = (folder_ / "axis.toml").string();
  write_axis_file(path, axis);
  auto read = read_axis_file(path);
  for (const auto& entry : plant::parameter_table()) EXPECT_EQ(entry.in(read), entry.in(axis)) << entry.key;
}

TEST_F(ServerConfigFile, AxesStandBesideTheConfigurationThatNamesThem) {
  write_axis_file((folder_ / "x.toml").string(), plant::source_axis());
  const auto config =
      read_server_config({.path = write("[server]\naxes = [\"x.toml\", \"x.toml\"]\n[[loopback]]\nmotion = \"sine\"\n"
                                        "[[loopback]]\nmotion = \"s_curve\"\n"),
                          .with_ports = false});
  ASSERT_EQ(config.axes.size(), 2U);
  EXPECT_EQ(config.loopback[0].motion->name, "sine");
  EXPECT_EQ(config.loopback[1].motion->name, "s_curve");
}

TEST_F(ServerConfigFile, TwoPortsOfOneKindAreToldApartByName) {
  const std::string second_bus =
      "[[port]]\nkind = \"can\"\n[[port]]\nkind = \"can\"\nname = \"can-b\"\ninterface = \"vcan1\"\n";
  const auto config = read_server_config({.path = write("[server]\ncontroller = \"can-b\"\n" + second_bus +
                                                        "[[fault]]\nkind = \"lost_command\"\nat_s = 1\nport = \"can\"\n")});
  ASSERT_EQ(config.ports.size(), 2U);
  EXPECT_EQ(config.ports[0].name, "can");
  EXPECT_EQ(config.ports[1].name, "can-b");
  EXPECT_EQ(config.controller, "can-b");
  EXPECT_NE(dynamic_cast<const io::faults::FaultPort*>(config.ports[0].port.get()), nullptr) << "the fault is on this one";
  EXPECT_EQ(dynamic_cast<const io::faults::FaultPort*>(config.ports[1].port.get()), nullptr);
  EXPECT_EQ(read_server_config({.path = write(second_bus), .controller = "can-b"}).controller, "can-b");

  EXPECT_NE(error_of("[[port]]\nkind = \"can\"\n[[port]]\nkind = \"can\"\n").find("a second port \"can\""),
            std::string::npos);
  EXPECT_NE(error_of("[[port]]\nkind = \"can\"\nname = \"udp\"\n").find("another kind of port"), std::string::npos);
  EXPECT_NE(error_of("[[port]]\nkind = \"can\"\nname = \"loopback\"\n").find(":3: port[0].name"), std::string::npos);
  EXPECT_NE(error_of("[server]\ncontroller = \"can-c\"\n" + second_bus).find("can-b, found \"can-c\""), std::string::npos);
}

TEST_F(ServerConfigFile, AMachineFileMakesThePlantAMachineTool) {
  const auto config = read_server_config({.path = write("[spindle]\nmotor = \"B\"\n[controller]\ntick_s = 5e-4\n")});
  ASSERT_NE(config.machine, nullptr);
  EXPECT_EQ(config.controller, "program");
  EXPECT_EQ(config.axes.size(), 2U);
  EXPECT_EQ(config.loop.tick_s, 5e-4);
  EXPECT_EQ(read_server_config({.path = write("[tool]\nteeth = 3\n"), .controller = "modbus"}).controller, "modbus");
  EXPECT_EQ(error_of("[server]\nperiod_s = 2e-3\n[tool]\nteeth = 3\n"), "");
  EXPECT_NE(error_of("[tool]\nteth = 3\n").find(":2: tool.teth: unknown key"), std::string::npos);
  EXPECT_NE(error_of("[server]\ncontroller = \"program\"\n").find("server.controller: expected one of"), std::string::npos)
      << "there is no program without a machine";
  write_axis_file((folder_ / "x.toml").string(), plant::source_axis());
  EXPECT_NE(error_of("[server]\naxes = [\"x.toml\"]\n[tool]\nteeth = 3\n").find("whose axes are [x] and [y]"),
            std::string::npos);
}

TEST_F(ServerConfigFile, ARecordedMotionFollowsItsFileAndSaysWhatIsMissing) {
  write_whole_file((folder_ / "run.csv").string(),
                   "time_s,torque_cmd_Nm,position_m\n0,0.1,0.5\n0.001,0.2,0.501\n0.002,0.3,0.503\n");
  const auto config = read_server_config({.path = write("[server]\ncontroller = \"loopback\"\n[loopback]\nmotion = "
                                                        "\"recorded\"\nrecording = \"run.csv\"\n")});
  const auto motion = config.loopback.at(0).motion->make(config.loopback[0].motion_settings);
  EXPECT_EQ(motion->at(0.0).position_m, 0.501) << "what is asked for in one tick acts in the next";
  EXPECT_EQ(config.loopback[0].gains.acceleration_feedforward_kg, 0.0) << "the recorded command holds the inertia's force";
  for (const auto& [keys, word] : std::vector<std::pair<std::string, std::string>>{
           {"motion = \"recorded\"\n", "recording"}, {"motion = \"recorded\"\nrecording = \"gone.csv\"\n", "gone.csv"}}) {
    try {
      (void)read_server_config({.path = write("[loopback]\n" + keys)});
      ADD_FAILURE() << "took " << keys;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace feedtwin::tools
