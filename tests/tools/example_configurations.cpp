// Every example configuration is one that the server takes, and every kind of port has one.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/registry.h"
#include "tools/config/input_error.h"
#include "tools/config/server_config.h"

namespace feedtwin::tools {
namespace {

const std::filesystem::path examples = std::string(FEEDTWIN_SOURCE_DIR) + "/systemd/examples";

TEST(ExampleConfigurations, AreAllOnesThatTheServerTakes) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(examples)) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NO_THROW((void)read_server_config({.path = entry.path().string()})) << entry.path();
    ++read;
  }
  EXPECT_GT(read, 0);
}

TEST(ExampleConfigurations, EveryKindOfPortHasOneOfItsName) {
  for (const auto& kind : io::port_kinds()) {
    const auto path = examples / (std::string(kind.name) + ".toml");
    ASSERT_TRUE(std::filesystem::exists(path)) << path;
    const auto config = read_server_config({.path = path.string()});
    EXPECT_TRUE(std::ranges::any_of(config.ports, [&](const auto& port) { return port.name == kind.name; })) << path;
  }
}

TEST(FaultList, WrongFaultsAreRefusedWithTheirLine) {
  const auto refused = [](const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / "feedtwin_fault_list_test.toml";
    std::FILE* file = std::fopen(path.c_str(), "w");
    std::fputs(text.c_str(), file);
    std::fclose(file);
    std::string said;
    try {
      (void)read_server_config({.path = path.string()});
    } catch (const InputError& error) {
      said = error.what();
    }
    std::filesystem::remove(path);
    return said;
  };
  EXPECT_NE(refused("[[fault]]\nat_s = 1.0\n").find("kind is missing"), std::string::npos);
  EXPECT_NE(refused("[[fault]]\nkind = \"lost_comand\"\nat_s = 1.0\n").find(":2: fault[0].kind"), std::string::npos);
  EXPECT_NE(refused("[[fault]]\nkind = \"lost_command\"\n").find("fault[0].at_s"), std::string::npos);
  EXPECT_NE(refused("[[fault]]\nkind = \"lost_command\"\nat_s = 1\naxis = 1\n").find(":4: fault[0].axis"),
            std::string::npos);
  EXPECT_NE(refused("[[fault]]\nkind = \"dead_a\"\nat_s = 1\nshare = 0.5\n").find("unknown key"), std::string::npos);
  EXPECT_NE(refused("[[fault]]\nkind = \"lost_command\"\nat_s = 1\nport = \"usb\"\n").find(":4: fault[0].port"),
            std::string::npos);
}

}  // namespace
}  // namespace feedtwin::tools
