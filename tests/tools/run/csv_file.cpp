#include "tools/run/csv_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

namespace fs = std::filesystem;

std::string scratch(const std::string& name) {
  return (fs::temp_directory_path() / ("feedtwin-" + std::to_string(::getpid()) + "-" + name)).string();
}

TEST(CsvFile, AFolderThatIsNotThereIsOneClearLine) {
  try {
    const CsvFile file("/nowhere/at/all/run.csv", "time_s");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/at/all/run.csv: log cannot be written: No such file or directory");
  }
}

/// A full disk, by the file size limit of a child process.
TEST(CsvFile, AFullDiskLeavesWholeRowsAndCountsTheRest) {
  const std::string path = scratch("full.csv");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::uint64_t unwritten = 0;
    {
      CsvFile file(path, "time_s,position_m");
      for (int i = 0; i < 20'000; ++i) file.add(fmt::format("{:.6f},{:.9f}", 0.001 * i, 1e-6 * i));
      file.flush();
      unwritten = file.unwritten_rows();
    }
    ::_exit(unwritten > 0 && unwritten < 20'000 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "rows were lost without being counted";
  const std::string text = read_whole_file(path);
  fs::remove(path);
  EXPECT_GT(text.size(), 1000U);
  EXPECT_EQ(text.back(), '\n') << "ends within a row";
}

TEST(CsvFile, AKilledProcessLeavesWhatWasFlushed) {
  const std::string path = scratch("killed.csv");
  const pid_t child = ::fork();
  if (child == 0) {
    CsvFile file(path, "time_s");
    for (int i = 0; i < 1000; ++i) file.add(std::to_string(i));
    file.flush();
    file.add("never");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::string text = read_whole_file(path);
  fs::remove(path);
  EXPECT_TRUE(text.ends_with("\n999\n"));
}

}  // namespace
}  // namespace feedtwin::tools
