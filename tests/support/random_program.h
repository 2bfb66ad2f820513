#pragma once
// Random RS-274 programs that are valid by construction, for property tests and comparisons. Deterministic by the seed.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

namespace feedtwin::tests {

struct RandomProgramSettings {
  int lines = 30;
  double extent_mm = 60.0;  ///< positions stay within +- this
  bool all_codes = true;    ///< planes, units, offsets, modes, M codes; otherwise lines, arcs and corners in XY
};

class RandomProgram {
 public:
  RandomProgram(unsigned seed, const RandomProgramSettings& settings) : random_(seed), settings_(settings) {}

  std::string text() {
    add("G21 G17 G90 G94 F%.1f S%d", uniform(50, 3000), static_cast<int>(uniform(500, 6000)));
    add("G0 X0 Y0 Z0");  // wherever the offsets put the start
    if (!settings_.all_codes) path_mode();
    for (int i = 0; i < settings_.lines; ++i) line();
    add("M2");
    return text_;
  }

 private:
  template <class... Arguments>
  void add(const char* format, Arguments... arguments) {
    char buffer[300];
    if constexpr (sizeof...(arguments) == 0) {
      std::snprintf(buffer, sizeof buffer, "%s", format);
    } else {
      std::snprintf(buffer, sizeof buffer, format, arguments...);
    }
    text_ += buffer;
    text_ += '\n';
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0, 1) < p; }

  void path_mode() {
    if (chance(0.2)) {
      add("G61");
    } else {
      add("G64 P%.4f", std::pow(10.0, uniform(-3, 0)) / unit_);
    }
  }

  void line() {
    const double kind = uniform(0, 1);
    if (kind < 0.55) {
      straight();
    } else if (kind < 0.85) {
      arc();
    } else if (settings_.all_codes) {
      mode();
    } else if (chance(0.3)) {
      path_mode();
    } else {
      feed();
    }
  }

  void feed() { add("F%.2f", std::pow(10.0, uniform(1.3, 3.7)) / unit_); }

  /// A word's value for moving an axis to a position, mm.
  double word(int axis, double to_mm) {
    const double value = (incremental_ ? to_mm - at_[axis] : to_mm) / unit_;
    return std::round(value * 1e5) / 1e5;
  }
  void go(int axis, double value) { at_[axis] = incremental_ ? at_[axis] + value * unit_ : value * unit_; }

  void straight() {
    const double reach = std::pow(10.0, uniform(-1.5, 2));  // from a few hundredths of a millimetre up
    double value[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double to = std::fmin(std::fmax(at_[axis] + uniform(-reach, reach), -settings_.extent_mm), settings_.extent_mm);
      value[axis] = word(axis, to);
    }
    const int code = chance(0.2) ? 0 : 1;
    const bool with_z = settings_.all_codes ? chance(0.4) : chance(0.1);
    if (with_z) {
      add("G%d X%.5f Y%.5f Z%.5f", code, value[0], value[1], value[2]);
      go(2, value[2]);
    } else {
      add("G%d X%.5f Y%.5f", code, value[0], value[1]);
    }
    go(0, value[0]);
    go(1, value[1]);
  }

  void arc() {
    const int first = (plane_ + 1) % 3, second = (plane_ + 2) % 3;
    const double radius = std::pow(10.0, uniform(-0.5, 1.4)), start = uniform(-std::numbers::pi, std::numbers::pi);
    const double sweep = uniform(0.05, 6.2) * (chance(0.5) ? 1 : -1);
    const double offset[2] = {-radius * std::cos(start), -radius * std::sin(start)};
    const double to[2] = {at_[first] + offset[0] + radius * std::cos(start + sweep),
                          at_[second] + offset[1] + radius * std::sin(start + sweep)};
    if (std::fabs(to[0]) > settings_.extent_mm || std::fabs(to[1]) > settings_.extent_mm) return;
    const double end[2] = {word(first, to[0]), word(second, to[1])};
    const char* letters = "XYZ";
    const int code = sweep > 0 ? 3 : 2;
    const bool by_radius = chance(0.3) && std::fabs(sweep) < 6.0 && std::fabs(std::fabs(sweep) - std::numbers::pi) > 0.1;
    if (by_radius) {
      add("G%d %c%.5f %c%.5f R%.5f", code, letters[first], end[0], letters[second], end[1],
          (std::fabs(sweep) > std::numbers::pi ? -radius : radius) / unit_);
    } else {
      add("G%d %c%.5f %c%.5f %c%.5f %c%.5f", code, letters[first], end[0], letters[second], end[1], "IJK"[first],
          offset[0] / unit_, "IJK"[second], offset[1] / unit_);
    }
    go(first, end[0]);
    go(second, end[1]);
  }

  void mode() {
    switch (static_cast<int>(uniform(0, 11))) {
      case 0: {
        unit_ = chance(0.5) ? 1.0 : 25.4;
        add(unit_ == 1.0 ? "G21" : "G20");
        feed();
        break;
      }
      case 1:
        incremental_ = !incremental_;
        add(incremental_ ? "G91" : "G90");
        break;
      case 2: {
        plane_ = static_cast<int>(uniform(0, 3));
        add("G%d", plane_ == 2 ? 17 : plane_ == 1 ? 18 : 19);
        break;
      }
      case 3:
        add("G4 P%.3f", uniform(0, 2));
        break;
      case 4:
        add(chance(0.5) ? "M3" : "M4");
        break;
      case 5:
        add(chance(0.5) ? "M8" : "M7");
        break;
      case 6:
        add(chance(0.5) ? "M5" : "M9");
        break;
      case 7:
        path_mode();
        break;
      case 8:
        add("T%d M6", static_cast<int>(uniform(1, 4)));
        break;
      case 9: {
        const double value = uniform(0.1, 20);
        add("#<v>=%.4f\nG91 G1 X[#<v>*2-#<v>] (there)\nX-#<v> ;and back\nG%d", value, incremental_ ? 91 : 90);
        break;
      }
      default:
        feed();
        break;
    }
  }

  std::mt19937 random_;
  RandomProgramSettings settings_;
  std::string text_;
  double at_[3] = {0, 0, 0};
  double unit_ = 1.0;  // mm
  bool incremental_ = false;
  int plane_ = 2;
};

inline std::string random_program(unsigned seed, const RandomProgramSettings& settings = {}) {
  return RandomProgram(seed, settings).text();
}

}  // namespace feedtwin::tests
