// Dependencies point one way. plant knows no one; controllers -> plant; io -> plant; rt -> plant, io/port.h and its clock;
// tools -> all.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> allowed{
    {"plant", {"plant"}},
    {"controllers", {"controllers", "plant"}},
    {"io", {"io", "plant"}},
    {"rt", {"rt", "plant", "io/port.h", "io/monotonic.h"}},
    {"tools", {"tools", "controllers", "io", "rt", "plant"}},
};

// Nothing that reads a clock, writes a log, opens a file or starts a thread has a place in the plant.
const std::set<std::string> not_in_plant{"chrono",       "thread",    "fstream", "iostream",       "filesystem",
                                         "mutex",        "ctime",     "future",  "cstdio",         "unistd.h",
                                         "sys/socket.h", "pthread.h", "time.h",  "spdlog/spdlog.h"};

struct Include {
  std::string file, target;
  bool own;  // "..." rather than <...>
};

std::vector<Include> includes_below(const std::string& folder) {
  const fs::path root = FEEDTWIN_SOURCE_DIR;
  const std::regex line(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string text; std::getline(file, text);) {
      if (std::regex_search(text, match, line)) {
        found.push_back({fs::relative(entry.path(), root).string(), match[2], match[1] == "\""});
      }
    }
  }
  return found;
}

std::vector<std::string> forbidden(const std::string& folder, const std::vector<Include>& includes) {
  std::vector<std::string> wrong;
  for (const auto& include : includes) {
    if (!include.own) {
      if (folder == "plant" && not_in_plant.contains(include.target))
        wrong.push_back(include.file + " -> " + include.target);
      continue;
    }
    const auto top = include.target.substr(0, include.target.find('/'));
    const auto& may = allowed.at(folder);
    if (!may.contains(top) && !may.contains(include.target)) wrong.push_back(include.file + " -> " + include.target);
  }
  return wrong;
}

TEST(Includes, PointOneWay) {
  for (const auto& [folder, may] : allowed) {
    const auto includes = includes_below(folder);
    ASSERT_GT(includes.size(), 5U) << folder << " was not read";
    for (const auto& wrong : forbidden(folder, includes)) ADD_FAILURE() << wrong;
  }
}

TEST(Includes, AForbiddenOneIsSeen) {
  EXPECT_EQ(forbidden("plant", {{"plant/x.h", "io/port.h", true}}).size(), 1U);
  EXPECT_EQ(forbidden("plant", {{"plant/x.h", "chrono", false}}).size(), 1U);
  EXPECT_EQ(forbidden("rt", {{"rt/x.h", "io/modbus/modbus_port.h", true}}).size(), 1U);
  EXPECT_TRUE(forbidden("rt", {{"rt/x.h", "io/port.h", true}}).empty());
}

}  // namespace
