#include "tools/recording/mat.h"

#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <random>

#include "tests/support/made_case.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

void write_mat(const std::string& path, mat_ft version, std::vector<double> t, std::vector<float> x) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  ASSERT_NE(file, nullptr);
  std::size_t column[] = {t.size(), 1}, row[] = {1, x.size()}, one[] = {1, 1};
  double gain = 3.0;
  for (matvar_t* variable : {Mat_VarCreate("t", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, column, t.data(), 0),
                             Mat_VarCreate("gain", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &gain, 0),
                             Mat_VarCreate("x", MAT_C_SINGLE, MAT_T_SINGLE, 2, row, x.data(), 0)}) {
    ASSERT_EQ(Mat_VarWrite(file, variable, MAT_COMPRESSION_ZLIB), 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

class MatFile : public testing::TestWithParam<mat_ft> {
 protected:
  void SetUp() override {
    for (int i = 0; i < 300; ++i) {
      t.push_back(i * 1e-3);
      x.push_back(static_cast<float>(i * i));
    }
  }
  tests::ScratchFolder folder{"mat"};
  std::vector<double> t;
  std::vector<float> x;
};

TEST_P(MatFile, GivesItsVectors) {
  write_mat(folder / "run.mat", GetParam(), t, x);
  const Table table = read_mat(folder / "run.mat");
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.find("t")->values, t);
  EXPECT_EQ(table.find("x")->values, std::vector<double>(x.begin(), x.end()));
  EXPECT_EQ(table.place(0, 4), (folder / "run.mat") + ": t(5)");
}

TEST_P(MatFile, RefusesWhatIsNotANumber) {
  x[17] = NAN;
  write_mat(folder / "run.mat", GetParam(), t, x);
  EXPECT_EQ(tests::complaint_of([&] { static_cast<void>(read_mat(folder / "run.mat")); }),
            (folder / "run.mat") + ": x(18): expected a finite number, found nan");
}

TEST_P(MatFile, CutShortIsRefusedOrWholeVectorsRemain) {
  write_mat(folder / "run.mat", GetParam(), t, x);
  const std::string whole = read_whole_file(folder / "run.mat");
  std::mt19937 random(6);
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t length = random() % whole.size();
    write_whole_file(folder / "cut.mat", whole.substr(0, length));
    try {
      const Table table = read_mat(folder / "cut.mat");
      for (const auto& column : table.columns) {
        ASSERT_EQ(column.values, column.name == "t" ? t : std::vector<double>(x.begin(), x.end())) << length;
      }
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
}

TEST_P(MatFile, SurvivesCorruption) {
  write_mat(folder / "run.mat", GetParam(), t, x);
  const std::string whole = read_whole_file(folder / "run.mat");
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = whole;
    for (std::size_t edits = 1 + random() % 3; edits > 0; --edits)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    write_whole_file(folder / "bad.mat", damaged);
    const std::string said = tests::complaint_of([&] {
      for (const auto& column : read_mat(folder / "bad.mat").columns) {
        for (const double value : column.values) ASSERT_TRUE(std::isfinite(value)) << "trial " << trial;
      }
    });
    ASSERT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

INSTANTIATE_TEST_SUITE_P(Versions, MatFile, testing::Values(MAT_FT_MAT5, MAT_FT_MAT73));

TEST(Mat, RefusesOtherFiles) {
  tests::ScratchFolder folder("mat");
  write_whole_file(folder / "run.mat", "time_s,x\n0,1\n");
  EXPECT_NE(tests::complaint_of([&] { static_cast<void>(read_mat(folder / "run.mat")); }).find("is not a MATLAB file"),
            std::string::npos);
  write_whole_file(folder / "run.mat", "");
  EXPECT_NE(tests::complaint_of([&] { static_cast<void>(read_mat(folder / "run.mat")); }).find("is not a MATLAB file"),
            std::string::npos);
  EXPECT_NE(tests::complaint_of([&] { static_cast<void>(read_mat(folder / "none.mat")); }).find("cannot be opened"),
            std::string::npos);
}

}  // namespace
}  // namespace feedtwin::tools
