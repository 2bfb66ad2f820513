#include "tools/recording/csv.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <random>

#include "tools/config/input_error.h"

namespace feedtwin::tools {
namespace {

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_csv(text, "run.csv"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, ReadsNamesAndNumbers) {
  const auto table = parse_csv("\xEF\xBB\xBFtime_s,x_m\r\n0,-1.5e-3\r\n0.001,2\r\n\r\n", "run.csv");
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[1].name, "x_m");
  EXPECT_EQ(table.columns[1].values, (std::vector<double>{-1.5e-3, 2.0}));
  EXPECT_EQ(table.place(1, 1), "run.csv:3:2");
}

TEST(Csv, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(complaint(""), "run.csv: is empty; expected a header line and rows of numbers");
  EXPECT_EQ(complaint("a,b\n"), "run.csv:1: holds no rows of numbers after the header line");
  EXPECT_EQ(complaint("a,b\n1,enabled\n2,fault\n"), "") << "a log's words";
  EXPECT_EQ(complaint("a,b\n1,enabled\n2,7x\n"), "run.csv:3:2: b: expected a finite number, found '7x'");
  EXPECT_EQ(complaint("a,b\n1,2\n1,two\n"), "run.csv:3:2: b: expected a finite number, found 'two'");
  EXPECT_EQ(complaint("a,b\n1,nan\n"), "run.csv:2:2: b: expected a finite number, found 'nan'");
  EXPECT_EQ(complaint("a,b\ninf,1\n"), "run.csv:2:1: a: expected a finite number, found 'inf'");
  EXPECT_EQ(complaint("a,b\n1,1e999\n"), "run.csv:2:2: b: expected a finite number, found '1e999'");
  EXPECT_EQ(complaint("a,b\n1,2\n3"), "run.csv:3: expected 2 columns, found 1 (is the file cut short?)");
  EXPECT_EQ(complaint("a,b\n1,2\n3,"), "run.csv:3:2: b: expected a finite number, found ''");
  EXPECT_EQ(complaint("a,b\n1,2,3\n1,2\n"), "run.csv:2: expected 2 columns, found 3");
  EXPECT_EQ(complaint("a,b\n1,2\n\n3,4\n"), "run.csv:3: is an empty line between rows");
  EXPECT_EQ(complaint("a,a\n1,2\n"), "run.csv:1:2: column 'a' is there twice");
  EXPECT_EQ(complaint("a;b\n1;2\n"), "run.csv:1:1: columns must be separated by commas, found 'a;b'");
  EXPECT_EQ(complaint("1,2\n3,4\n"), "run.csv:1:1: expected a header line of column names, found the number 1");
  EXPECT_EQ(complaint("a,\n1,2\n"), "run.csv:1:2: a column without a name");
}

TEST(Csv, GivesEveryNumberBackExactly) {
  std::mt19937_64 random(3);
  Column a{"a", {}}, b{"b", {}};
  for (int i = 0; i < 2000; ++i) {
    const auto bits = random();
    const double value = __builtin_bit_cast(double, bits);
    a.values.push_back(std::isfinite(value) ? value : 0.0);
    b.values.push_back(static_cast<double>(i) * 1e-3);
  }
  const std::string path = (std::filesystem::path(testing::TempDir()) / "feedtwin_round_trip.csv").string();
  write_csv(path, {a, b});
  const auto table = read_csv(path);
  std::filesystem::remove(path);
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].values, a.values);
  EXPECT_EQ(table.columns[1].values, b.values);
}

TEST(Csv, SurvivesAnyCorruption) {
  std::string good = "time_s,torque_cmd_Nm,position_m\n";
  for (int i = 0; i < 60; ++i) good += std::to_string(i * 1e-3) + ",0.25," + std::to_string(i * i * 1e-6) + "\n";
  std::mt19937 random(4);
  int refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = good;
    for (std::size_t edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, 1 + random() % 40);
          break;
        case 2:
          text.insert(at, 1, ",\n.-e\0x"[random() % 7]);
          break;
        default:
          text.resize(at);
      }
    }
    try {
      const auto table = parse_csv(text, "run.csv");
      for (const auto& column : table.columns) {
        ASSERT_EQ(column.values.size(), table.columns.front().values.size()) << text;
        for (const double value : column.values) ASSERT_TRUE(std::isfinite(value)) << text;
      }
    } catch (const InputError& error) {
      ++refused;
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ASSERT_EQ(std::string(error.what()).rfind("run.csv:", 0), 0U) << error.what();
    }
  }
  EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace feedtwin::tools
