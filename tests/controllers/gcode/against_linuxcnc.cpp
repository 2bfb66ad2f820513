// The same programs read by LinuxCNC's stand-alone interpreter (rs274, Debian's linuxcnc-uspace) give the same moves.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "controllers/gcode/interpreter.h"
#include "tests/support/random_program.h"

namespace feedtwin::controllers::gcode {
namespace {

constexpr double inch_m = 25.4e-3;

/// One canonical call, reduced to what both interpreters say.
struct Call {
  std::string name;
  std::vector<double> numbers;  // metres, seconds, rad
  double within = 0.0;          // rs274 prints four decimals
};

std::string shown(const Call& call) {
  std::ostringstream out;
  out << call.name;
  for (const double n : call.numbers) out << ' ' << n;
  return out.str();
}

std::vector<Call> ours(const Program& program) {
  std::vector<Call> calls;
  const auto xyz = [](const Point& p) { return std::vector<double>{p.x, p.y, p.z}; };
  for (const auto& command : program) {
    if (const auto* t = std::get_if<StraightTraverse>(&command.action)) calls.push_back({"traverse", xyz(t->to_m)});
    if (const auto* f = std::get_if<StraightFeed>(&command.action)) {
      auto numbers = xyz(f->to_m);
      numbers.push_back(f->feed_m_per_s * 60.0);
      calls.push_back({"feed", numbers});
    }
    if (const auto* a = std::get_if<ArcFeed>(&command.action)) {
      auto numbers = xyz(a->to_m);
      numbers.push_back(a->feed_m_per_s * 60.0);
      numbers.push_back(a->centre_m[(a->axis + 1) % 3]);
      numbers.push_back(a->centre_m[(a->axis + 2) % 3]);
      calls.push_back({"arc axis " + std::to_string(a->axis) + (a->sweep_rad > 0 ? " ccw" : " cw"), numbers});
    }
    if (const auto* d = std::get_if<Dwell>(&command.action)) calls.push_back({"dwell", {d->duration_s}});
    if (const auto* c = std::get_if<ChangeTool>(&command.action)) calls.push_back({"change tool", {1.0 * c->tool}});
    if (const auto* s = std::get_if<ProgramStop>(&command.action)) calls.push_back({s->optional ? "M1" : "M0", {}});
    if (const auto* p = std::get_if<SetPathMode>(&command.action)) {
      calls.push_back({p->mode == PathMode::continuous   ? "continuous"
                       : p->mode == PathMode::exact_path ? "exact path"
                                                         : "exact stop",
                       {p->tolerance_m}});
    }
  }
  return calls;
}

/// Reads rs274's listing.
class Listing {
 public:
  std::vector<Call> read(std::istream& in) {
    for (std::string line; std::getline(in, line);) take(line);
    return calls_;
  }
  bool ended = false;

 private:
  void take(const std::string& line) {
    const auto open = line.find('(');
    constexpr std::size_t name_from = 13;  // after the call's number and the line's
    if (open == std::string::npos || open < name_from) return;
    const std::string name = line.substr(name_from, open - name_from);
    const std::string inside = line.substr(open + 1, line.rfind(')') - open - 1);
    std::vector<double> n;
    std::istringstream numbers(inside);
    for (std::string item; std::getline(numbers, item, ',');) n.push_back(std::strtod(item.c_str(), nullptr));
    call(name, inside, n);
  }

  [[nodiscard]] Point position(double x, double y, double z) const { return unit_m_ * Point{x, y, z} + offset_m_; }
  void push(const std::string& name, const Point& to, std::vector<double> more = {}) {
    std::vector<double> numbers{to.x, to.y, to.z};
    numbers.insert(numbers.end(), more.begin(), more.end());
    calls_.push_back({name, numbers, 1.5e-4 * unit_m_});
  }

  void call(const std::string& name, const std::string& inside, const std::vector<double>& n) {
    if (name == "USE_LENGTH_UNITS") unit_m_ = inside.find("MM") != std::string::npos ? 1e-3 : inch_m;
    if (name == "SET_G5X_OFFSET") offset_m_ = unit_m_ * Point{n[1], n[2], n[3]};
    if (name == "SELECT_PLANE")
      axis_ = inside.find("XY") != std::string::npos ? 2 : inside.find("XZ") != std::string::npos ? 1 : 0;
    if (name == "SET_FEED_RATE") feed_m_per_min_ = n[0] * unit_m_;
    if (name == "STRAIGHT_TRAVERSE") push("traverse", position(n[0], n[1], n[2]));
    if (name == "STRAIGHT_FEED") push("feed", position(n[0], n[1], n[2]), {feed_m_per_min_});
    if (name == "ARC_FEED") arc(n);
    if (name == "DWELL") calls_.push_back({"dwell", {n[0]}, 1e-4});
    if (name == "CHANGE_TOOL") calls_.push_back({"change tool", {n[0]}, 1e-9});
    if (name == "PROGRAM_STOP") calls_.push_back({"M0", {}, 0});
    if (name == "OPTIONAL_PROGRAM_STOP") calls_.push_back({"M1", {}, 0});
    if (name == "PROGRAM_END" || name == "FINISH") ended = true;  // M2, M30; the closing %
    if (name == "SET_MOTION_CONTROL_MODE") {
      const bool continuous = inside.find("CONTINUOUS") != std::string::npos;
      calls_.push_back({continuous                                       ? "continuous"
                        : inside.find("EXACT_PATH") != std::string::npos ? "exact path"
                                                                         : "exact stop",
                        {continuous && n.size() > 1 ? n[1] * unit_m_ : 0.0},
                        1e-6 * unit_m_});
    }
  }

  void arc(const std::vector<double>& n) {
    const int first = (axis_ + 1) % 3, second = (axis_ + 2) % 3;
    Point to, centre;
    to[first] = n[0];
    to[second] = n[1];
    to[axis_] = n[5];
    centre[first] = n[2];
    centre[second] = n[3];
    centre = unit_m_ * centre + offset_m_;
    push("arc axis " + std::to_string(axis_) + (n[4] > 0 ? " ccw" : " cw"), unit_m_ * to + offset_m_,
         {feed_m_per_min_, centre[first], centre[second]});
  }

  std::vector<Call> calls_;
  double unit_m_ = 1e-3, feed_m_per_min_ = 0.0;
  Point offset_m_;
  int axis_ = 2;
};

class AgainstLinuxCnc : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v rs274 >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "rs274 is not installed (Debian: linuxcnc-uspace)";
    }
    directory_ = std::filesystem::temp_directory_path() / ("feedtwin-rs274-" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override {
    if (!directory_.empty()) std::filesystem::remove_all(directory_);
  }

  /// Offsets of G54 .. G59.3 and home as rs274's parameter file wants them: in inches, its unit where no INI file says else.
  [[nodiscard]] std::string write_parameters(const Parameters& parameters) const {
    const auto path = directory_ / "parameters.var";
    std::ofstream out(path);
    out.precision(15);
    const auto block = [&](int from, int count) {
      for (int i = from; i < from + count; ++i)
        out << i << '\t' << parameters.numbered[static_cast<std::size_t>(i)] * 1e-3 / inch_m << '\n';
    };
    block(5161, 9);
    block(5181, 9);
    block(5210, 10);
    out << "5220\t1\n";
    for (int system = 0; system < 9; ++system) block(5221 + 20 * system, 10);
    return path;
  }

  void compare(const std::string& path, const InterpreterSettings& settings) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto mine = ours(interpret(text, settings));
    const auto listing_path = (directory_ / "listing").string();
    // two of them at once share memory and crash with a bus error: one at a time
    const std::string one_at_a_time =
        "flock " + (std::filesystem::temp_directory_path() / "feedtwin-rs274.lock").string() + " ";
    const std::string command = one_at_a_time + "rs274 -g -v " + write_parameters(settings.parameters) + " '" + path +
                                "' '" + listing_path + "' >/dev/null 2>" + listing_path + ".errors";
    (void)std::system(command.c_str());
    std::ifstream listing(listing_path);
    Listing reader;
    const auto theirs = reader.read(listing);
    std::ifstream errors(listing_path + ".errors");
    ASSERT_TRUE(reader.ended) << path << ": " << std::string(std::istreambuf_iterator<char>(errors), {}) << "\n" << text;
    ASSERT_EQ(mine.size(), theirs.size()) << path;
    for (std::size_t i = 0; i < mine.size(); ++i) {
      ASSERT_EQ(mine[i].name, theirs[i].name)
          << path << " call " << i << ": " << shown(mine[i]) << " / " << shown(theirs[i]);
      for (std::size_t k = 0; k < mine[i].numbers.size(); ++k) {
        ASSERT_NEAR(mine[i].numbers[k], theirs[i].numbers[k], theirs[i].within)
            << path << " call " << i << ": " << shown(mine[i]) << " / " << shown(theirs[i]);
      }
    }
    calls_ += mine.size();
  }

  std::filesystem::path directory_;
  std::size_t calls_ = 0;
};

TEST_F(AgainstLinuxCnc, RandomProgramsGiveTheSameMoves) {
  const int programs = std::getenv("FEEDTWIN_ALL_TESTS") != nullptr ? 2000 : 60;
  InterpreterSettings settings;
  std::mt19937 random(7);
  for (const int index : {5161, 5162, 5163, 5221, 5222, 5241, 5243, 5262}) {
    settings.parameters.numbered[static_cast<std::size_t>(index)] =
        std::round(std::uniform_real_distribution<>(-9e4, 9e4)(random)) / 1e3;
  }
  for (int i = 0; i < programs; ++i) {
    const auto path = (directory_ / "program.ngc").string();
    std::ofstream(path) << tests::random_program(static_cast<unsigned>(i), {.lines = 60});
    compare(path, settings);
    if (HasFatalFailure()) {
      std::ifstream file(path);
      FAIL() << "seed " << i << "\n" << std::string(std::istreambuf_iterator<char>(file), {});
    }
  }
  RecordProperty("calls_compared", static_cast<int>(calls_));
  std::printf("%zu canonical calls agree\n", calls_);
}

TEST_F(AgainstLinuxCnc, ChosenProgramsGiveTheSameMoves) {
  InterpreterSettings settings;
  for (const int index : {5161, 5162, 5163, 5221, 5241, 5261, 5281, 5301, 5321, 5341, 5361, 5381}) {
    settings.parameters.numbered[static_cast<std::size_t>(index)] = index - 5200;
  }
  const char* programs[] = {
      "G28\nG28 X1 Z2\nG91 G28 Y3\nM2\n",
      "G0 X1 Y2\nG55 G0 X1\nG56 X1\nG57 Y1\nG58 X1\nG59 X1\nG59.1 X1\nG59.2 X2\nG59.3 Z1\nG53 G1 X1 F10\nM2\n",
      "F100 G61\nG61.1\nG64\nG64 P0.02\nG20 G64 P0.001\nM0\nM1\nG4 P1.5\nM30\n",
      "G93 G1 X10 F2\nG2 X20 Y10 I10 F3\nG94 F100\nG1 X0\nG20 G1 X1 F5\nG93 X2 Y2 F6\nM2\n",
      "F50 G17 G0 X0 Y0 Z0\nG2 I5 P3\nG3 X10 I5 P2 Z3\nG18 G2 X0 Z1 R20\nG19 G3 Y5 Z5 R-4\nM2\n",
      "%\n#1=2\n#[#1+1]=4.5\nF[#1*10] G1 X#3 Y-#1 Z[#3 mod #1]\nG80\nG40 G1 X[sin[45]**2 / 0.25]\n%\n",
      "G91 G20 G1 X1 F10\nG21 X1\nG90 X5 F30\nG0 X[atan[1]/[2]] Y[[1 + 2] * 3 gt 8]\nM2\n",
  };
  for (const char* text : programs) {
    const auto path = (directory_ / "program.ngc").string();
    std::ofstream(path) << text;
    ASSERT_NO_THROW(compare(path, settings)) << text;
  }
}

/// A program that is refused for a code outside the supported set is passed over; any other difference is an error.
TEST_F(AgainstLinuxCnc, ItsOwnSampleProgramsGiveTheSameMoves) {
  std::vector<std::string> read, refused;
  for (const char* root : {"/usr/share/linuxcnc/ncfiles", "/usr/share/axis/images", "/usr/share/doc/linuxcnc/examples"}) {
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file() || entry.path().extension() != ".ngc") continue;
      try {
        compare(entry.path(), {});
        read.push_back(entry.path().filename());
      } catch (const GcodeError& error) {
        refused.push_back(entry.path().filename().string() + ":" + std::to_string(error.line()) + ": " + error.what());
      }
      if (HasFatalFailure()) return;
    }
  }
  std::printf("%zu sample programs agree (%zu canonical calls), %zu are outside the supported set\n", read.size(), calls_,
              refused.size());
  for (const auto& name : read) std::printf("  agrees: %s\n", name.c_str());
  if (std::getenv("FEEDTWIN_VERBOSE") != nullptr) {
    for (const auto& name : refused) std::printf("  refused: %s\n", name.c_str());
  }
  EXPECT_FALSE(read.empty());
}

}  // namespace
}  // namespace feedtwin::controllers::gcode
