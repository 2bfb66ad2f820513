#include "controllers/gcode/interpreter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace feedtwin::controllers::gcode {
namespace {

constexpr double rpm = 2.0 * std::numbers::pi / 60.0;

template <class A>
std::vector<A> all(const Program& program) {
  std::vector<A> found;
  for (const auto& command : program) {
    if (const auto* action = std::get_if<A>(&command.action)) found.push_back(*action);
  }
  return found;
}

Program run(const std::string& text) {
  return interpret(text + "\nM2\n");
}

void expect_at(const Point& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-12);
  EXPECT_NEAR(p.y, y, 1e-12);
  EXPECT_NEAR(p.z, z, 1e-12);
}

TEST(Interpreter, MovesAreInMachineCoordinatesAndSi) {
  const auto feeds = all<StraightFeed>(run("g21 g90\nG1 X10 Y-5 F600\nG20 G91 X1 F60\nG1 x 0 . 5"));
  ASSERT_EQ(feeds.size(), 3U);
  expect_at(feeds[0].to_m, 0.010, -0.005, 0.0);
  EXPECT_DOUBLE_EQ(feeds[0].feed_m_per_s, 0.010);
  expect_at(feeds[1].to_m, 0.0354, -0.005, 0.0);
  EXPECT_DOUBLE_EQ(feeds[1].feed_m_per_s, 0.001) << "F counts in the units before the line's G20";
  expect_at(feeds[2].to_m, 0.0481, -0.005, 0.0);
}

TEST(Interpreter, OffsetsComeFromTheParameters) {
  InterpreterSettings settings;
  settings.parameters.numbered[5221] = 100.0;
  settings.parameters.numbered[5241 + 1] = -7.0;
  settings.parameters.numbered[5381 + 2] = 3.0;
  const auto moves =
      all<StraightTraverse>(interpret("G0X1\nG55 G0X1Y1\nG53 G0 Y2\nG59.3 Z1\nG91 X1\n#5221=5\nG90 G54 X0\nM2", settings));
  ASSERT_EQ(moves.size(), 6U);
  expect_at(moves[0].to_m, 0.101, 0, 0);
  expect_at(moves[1].to_m, 0.001, -0.006, 0);
  expect_at(moves[2].to_m, 0.001, 0.002, 0);
  expect_at(moves[3].to_m, 0.001, 0.002, 0.004);
  expect_at(moves[4].to_m, 0.002, 0.002, 0.004);
  expect_at(moves[5].to_m, 0.005, 0.002, 0.004);
}

TEST(Interpreter, HomeIsReachedThroughThePointGiven) {
  InterpreterSettings settings;
  settings.parameters.numbered[5161] = -20.0;
  settings.parameters.numbered[5163] = 30.0;
  const auto moves = all<StraightTraverse>(interpret("G0 X5 Y6 Z7\nG28 Z10\nG28\nM2", settings));
  ASSERT_EQ(moves.size(), 5U);
  expect_at(moves[1].to_m, 0.005, 0.006, 0.010);
  expect_at(moves[2].to_m, 0.005, 0.006, 0.030);
  expect_at(moves[4].to_m, -0.020, 0.0, 0.030);
}

TEST(Interpreter, ArcsByCentreAndByRadiusAgree) {
  const auto arcs =
      all<ArcFeed>(run("G1 X10 F60\nG3 X0 Y10 I-10\nG0 X10 Y0\nG3 X0 Y10 R10\nG2 X10 Y0 R-10\nG2 X10 Y0 I-10 P2 Z4"));
  ASSERT_EQ(arcs.size(), 4U);
  EXPECT_NEAR(arcs[0].sweep_rad, std::numbers::pi / 2, 1e-12);
  expect_at(arcs[0].centre_m, 0, 0, 0);
  EXPECT_NEAR(arcs[1].sweep_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(arcs[1].centre_m.x, 0.0, 1e-12);
  EXPECT_NEAR(arcs[2].sweep_rad, -1.5 * std::numbers::pi, 1e-12);
  expect_at(arcs[2].centre_m, 0.010, 0.010, 0);
  EXPECT_NEAR(arcs[3].sweep_rad, -4 * std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(arcs[3].to_m.z, 0.004);
}

TEST(Interpreter, PlanesTurnRightHandedAboutTheirAxis) {
  const auto arcs = all<ArcFeed>(run("F60\nG18 G3 X10 Z10 I10\nG0 X0 Y0 Z0\nG19 G3 Y10 Z10 K10"));
  ASSERT_EQ(arcs.size(), 2U);
  EXPECT_EQ(arcs[0].axis, 1);
  EXPECT_NEAR(arcs[0].sweep_rad, std::numbers::pi * 0.5, 1e-12);  // z towards x
  EXPECT_EQ(arcs[1].axis, 0);
  EXPECT_NEAR(arcs[1].sweep_rad, std::numbers::pi * 0.5, 1e-12);  // y towards z
}

TEST(Interpreter, FeedModesGiveTheSamePathSpeed) {
  const auto feeds = all<StraightFeed>(run("S600\nG94 F300 G1 X10\nG93 F30 X20\nG95 F0.5 X30\nG93 X30 Y30 F1"));
  ASSERT_EQ(feeds.size(), 4U);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(feeds[static_cast<std::size_t>(i)].feed_m_per_s, 0.005, 1e-15) << i;
  EXPECT_NEAR(feeds[3].feed_m_per_s, 0.030 / 60.0, 1e-15);
}

TEST(Interpreter, SpindleAndPumpFollowTheirCodes) {
  const auto program = run("S3000 M3 M8 M7\nM9\nM4\nM6 T2\nM3");
  const auto spindle = all<SetSpindle>(program);
  ASSERT_EQ(spindle.size(), 6U);
  EXPECT_DOUBLE_EQ(spindle[1].speed_rad_per_s, 3000 * rpm);
  EXPECT_EQ(spindle[1].turn, SpindleTurn::clockwise);
  EXPECT_EQ(spindle[2].turn, SpindleTurn::counterclockwise);
  EXPECT_EQ(spindle[3].turn, SpindleTurn::off) << "a tool change stops the spindle";
  EXPECT_EQ(spindle[5].turn, SpindleTurn::off) << "so does the end";
  const auto coolant = all<SetCoolant>(program);
  ASSERT_EQ(coolant.size(), 2U);
  EXPECT_TRUE(coolant[0].flood && coolant[0].mist);
  EXPECT_FALSE(coolant[1].flood || coolant[1].mist);
  EXPECT_EQ(all<ChangeTool>(program)[0].tool, 2);
}

TEST(Interpreter, ExpressionsFollowTheirPrecedence) {
  const auto x = [](const std::string& expression) {
    return all<StraightTraverse>(run("#1=3 #2=1\n#<big one>=7\nG0 X" + expression)).at(0).to_m.x * 1e3;
  };
  EXPECT_DOUBLE_EQ(x("[2 + 3 * 4 ** 2]"), 50.0);
  EXPECT_DOUBLE_EQ(x("[[2 + 3] * 4 - 6 / 3 - 1]"), 17.0);
  EXPECT_DOUBLE_EQ(x("-[7 mod 4]"), -3.0);
  EXPECT_NEAR(x("[sin[30] + atan[1]/[1]]"), 45.5, 1e-12);
  EXPECT_DOUBLE_EQ(x("#1"), 3.0);
  EXPECT_DOUBLE_EQ(x("##2"), 3.0);
  EXPECT_DOUBLE_EQ(x("-#<BigOne>"), -7.0);
  EXPECT_DOUBLE_EQ(x("[1 lt 2 and 3 ge 4]"), 0.0);
  EXPECT_DOUBLE_EQ(x("[exists[#<bigone>] + exists[#<none>]]"), 1.0);
  EXPECT_DOUBLE_EQ(x("[fix[-2.5] + fup[2.2] + round[1.5]]"), 2.0);
}

TEST(Interpreter, AParameterTakesEffectAfterItsLine) {
  const auto moves = all<StraightTraverse>(run("#1=5\n#1=6 G0 X#1\nX#1"));
  EXPECT_DOUBLE_EQ(moves.at(0).to_m.x, 0.005);
  EXPECT_DOUBLE_EQ(moves.at(1).to_m.x, 0.006);
}

TEST(Interpreter, PercentSignsAndDeletedLines) {
  EXPECT_EQ(interpret("%\nG0 X1\n%\nrubbish").size(), 2U);
  InterpreterSettings settings;
  EXPECT_EQ(all<StraightTraverse>(interpret("/G0 X1\nM2", settings)).size(), 1U);
  settings.block_delete = true;
  EXPECT_EQ(all<StraightTraverse>(interpret("/G0 X1\nM2", settings)).size(), 0U);
}

struct Wrong {
  const char* text;
  std::size_t line, column;
  const char* contains;
};
class WrongPrograms : public testing::TestWithParam<Wrong> {};

TEST_P(WrongPrograms, AreNamedWithLineAndColumn) {
  const auto& wrong = GetParam();
  try {
    (void)interpret(wrong.text);
    FAIL() << "was taken: " << wrong.text;
  } catch (const GcodeError& error) {
    EXPECT_EQ(error.line(), wrong.line) << error.what();
    EXPECT_EQ(error.column(), wrong.column) << error.what();
    EXPECT_NE(std::string(error.what()).find(wrong.contains), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Interpreter, WrongPrograms,
    testing::Values(Wrong{"G0 X1\nG83 X1\nM2", 2, 1, "G83 is not supported"}, Wrong{"M98\nM2", 1, 1, "M98"},
                    Wrong{"G1 X1 F0\nM2", 1, 1, "without a feed"}, Wrong{"G0 X1 X2\nM2", 1, 7, "second X"},
                    Wrong{"G0 G1 X1\nM2", 1, 4, "excludes"}, Wrong{"G0 X[1+\nM2", 1, 8, "end of the line"},
                    Wrong{"G0 X1..2\nM2", 1, 7, "unexpected character"}, Wrong{"G0 X[1/0]\nM2", 1, 5, "finite"},
                    Wrong{"G0 X#<a>\nM2", 1, 5, "never set"}, Wrong{"#0=1\nM2", 1, 2, "parameter number"},
                    Wrong{"G0 A1\nM2", 1, 4, "letter A"}, Wrong{"(open\nM2", 1, 1 + 1, "not closed"},
                    Wrong{"G2 X1 F1\nM2", 1, 1, "without a radius"}, Wrong{"G2 X10 I1 F1\nM2", 1, 8, "differ"},
                    Wrong{"G2 X10 R1 F1\nM2", 1, 8, "too small"}, Wrong{"G2 X0 R1 F1\nM2", 1, 7, "whole circle"},
                    Wrong{"G2 X1 K1 F1\nM2", 1, 7, "plane"}, Wrong{"G1 X1 R1 F1\nM2", 1, 7, "without G2 or G3"},
                    Wrong{"G80 X1\nM2", 1, 5, "without a motion"}, Wrong{"G4\nM2", 1, 1, "P word"},
                    Wrong{"G53 X1 G2 I1 F1\nM2", 1, 1, "G53"}, Wrong{"G28 G0 X1\nM2", 1, 5, "G28"},
                    Wrong{"G0 X1\n\nX2", 3, 1, "no end"}, Wrong{"", 1, 1, "no end"}, Wrong{"G0 X1e3\nM2", 1, 6, "letter E"},
                    Wrong{"M3 M4\nM2", 1, 4, "excludes"}, Wrong{"G61.2\nM2", 1, 1, "G61.2"},
                    Wrong{"G1.05\nM2", 1, 1, "code"}, Wrong{"G93 G1 X1 F1\nX2\nM2", 2, 1, "G93"},
                    Wrong{"G95 G1 X1 F1\nM2", 1, 1, "spindle speed"}, Wrong{"G0 X99999999999\nM2", 1, 4, "reach"},
                    Wrong{"S-1\nM2", 1, 1, "speed"}));

TEST(Interpreter, DeepNestingIsRefused) {
  EXPECT_THROW((void)run("G0 X" + std::string(100000, '[')), GcodeError);
  EXPECT_THROW((void)run("G0 X" + std::string(100000, '#')), GcodeError);
  EXPECT_THROW((void)run("G0 X" + std::string(100000, '-') + "1"), GcodeError);
}

}  // namespace
}  // namespace feedtwin::controllers::gcode
