#include "controllers/gcode/interpreter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "controllers/gcode/arc.h"
#include "controllers/gcode/block.h"
#include "controllers/gcode/feed.h"
#include "controllers/gcode/line_codes.h"
#include "controllers/gcode/word_rules.h"

namespace feedtwin::controllers::gcode {
namespace {

constexpr double mm = 1e-3;
constexpr double inch = 25.4e-3;
constexpr double rpm = 2.0 * std::numbers::pi / 60.0;
constexpr double largest_coordinate_m = 1e4;  // beyond any machine; keeps all that follows finite
constexpr double largest_dwell_s = 1e5;
constexpr double largest_speed_rpm = 1e6;

enum class Motion { traverse = 0, feed = 1, clockwise = 2, counterclockwise = 3, none = no_motion };

class Interpreter {
 public:
  explicit Interpreter(const InterpreterSettings& settings)
      : parameters_(settings.parameters), block_delete_(settings.block_delete), at_m_(settings.start_m) {
    select_coordinates(0);
  }

  Program run(std::string_view text) {
    std::size_t line = 0;
    bool percent_seen = false, anything = false;
    while (!ended_ && !text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view content = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line;
      if (Scanner(content, line).peek() == '%') {
        if (percent_seen || anything) emit(line, ProgramEnd{});
        ended_ = percent_seen || anything;
        percent_seen = true;
        continue;
      }
      const Block block = read_block(content, line, parameters_);
      if (!(block.deleted && block_delete_)) execute(block);
      anything = true;
    }
    if (!ended_) throw GcodeError(std::max<std::size_t>(line, 1), 1, "the program has no end (M2, M30 or a closing %)");
    return std::move(program_);
  }

 private:
  template <class A>
  void emit(std::size_t line, A action) {
    program_.push_back({line, Action{action}});
  }

  // In the order of NISTIR 6556, table 8.
  void execute(const Block& block) {
    const Codes codes = sort_codes(block);
    check_words(block, codes, static_cast<int>(motion_));
    feed_.read(block, codes, unit_m_);
    if (const auto& s = block.word('s')) spindle_speed(block, *s);
    if (const auto& t = block.word('t')) select_tool(block, *t);
    m_codes(block, codes);
    if (is(codes[GGroup::non_modal], 40)) dwell(block);
    modes(block, codes);
    if (is(codes[GGroup::non_modal], 280)) {
      go_home(block);
    } else {
      motion(block, codes);
    }
    for (const auto& setting : block.settings) set_parameter(setting);
    stopping(block, codes);
  }

  void spindle_speed(const Block& block, const Word& s) {
    if (s.value < 0.0 || s.value > largest_speed_rpm) block.fail(s.at, "expected a spindle speed from 0 to 1e6 rpm");
    spindle_.speed_rad_per_s = s.value * rpm;
    emit(block.line, spindle_);
  }

  void select_tool(const Block& block, const Word& t) {
    const double whole = std::round(t.value);
    if (whole < 0.0 || whole > 1e6 || std::abs(whole - t.value) > 1e-4) block.fail(t.at, "expected a tool number after T");
    tool_ = static_cast<int>(whole);
    emit(block.line, SelectTool{tool_});
  }

  void m_codes(const Block& block, const Codes& codes) {
    if (codes[MGroup::tool_change]) {
      spindle_off(block);
      emit(block.line, ChangeTool{tool_});
    }
    if (const auto& code = codes[MGroup::spindle]) {
      spindle_.turn = code->tenths == 30   ? SpindleTurn::clockwise
                      : code->tenths == 40 ? SpindleTurn::counterclockwise
                                           : SpindleTurn::off;
      emit(block.line, spindle_);
    }
    if (codes[MGroup::coolant]) {
      const bool off = !codes.mist && !codes.flood;
      coolant_ = off ? SetCoolant{} : SetCoolant{coolant_.mist || codes.mist, coolant_.flood || codes.flood};
      emit(block.line, coolant_);
    }
  }

  void spindle_off(const Block& block) {
    if (spindle_.turn == SpindleTurn::off) return;
    spindle_.turn = SpindleTurn::off;
    emit(block.line, spindle_);
  }

  void dwell(const Block& block) {
    const auto& p = block.word('p');
    if (!p) block.fail(0, "G4 without a P word, s");
    if (p->value < 0.0 || p->value > largest_dwell_s) block.fail(p->at, "expected a dwell from 0 to 1e5 s");
    emit(block.line, Dwell{p->value});
  }

  void modes(const Block& block, const Codes& codes) {
    if (const auto& code = codes[GGroup::plane]) plane_axis_ = code->tenths == 170 ? 2 : code->tenths == 180 ? 1 : 0;
    if (const auto& code = codes[GGroup::units]) unit_m_ = code->tenths == 200 ? inch : mm;
    if (const auto& code = codes[GGroup::coordinates]) {
      select_coordinates(code->tenths <= 590 ? (code->tenths - 540) / 10 : code->tenths - 585);
    }
    if (const auto& code = codes[GGroup::path_mode]) path_mode(block, *code);
    if (const auto& code = codes[GGroup::distance]) incremental_ = code->tenths == 910;
  }

  void path_mode(const Block& block, const Code& code) {
    SetPathMode mode{code.tenths == 610   ? PathMode::exact_path
                     : code.tenths == 611 ? PathMode::exact_stop
                                          : PathMode::continuous};
    for (const char letter : {'p', 'q'}) {
      const auto& word = block.word(letter);
      if (word && code.tenths == 640 && word->value < 0.0) block.fail(word->at, "expected a tolerance from 0 up");
    }
    const auto& p = block.word('p');
    if (p && code.tenths == 640) mode.tolerance_m = p->value * unit_m_;
    emit(block.line, mode);
  }

  void select_coordinates(int system) {
    for (int axis = 0; axis < 3; ++axis) {
      offset_m_[axis] = mm * numbered(first_offset_parameter + parameters_per_system * system + axis);
    }
  }

  [[nodiscard]] double numbered(int index) const { return parameters_.numbered[static_cast<std::size_t>(index)]; }

  static constexpr std::array<char, 3> axis_letters{'x', 'y', 'z'};

  Point target(const Block& block, bool machine_coordinates) const {
    Point to = at_m_;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& word = block.word(axis_letters[static_cast<std::size_t>(axis)]);
      if (!word) continue;
      const double value_m = word->value * unit_m_;
      if (machine_coordinates) {
        to[axis] = value_m;
      } else {
        to[axis] = incremental_ ? at_m_[axis] + value_m : offset_m_[axis] + value_m;
      }
      if (!(std::abs(to[axis]) <= largest_coordinate_m)) block.fail(word->at, "the position is out of any machine's reach");
    }
    return to;
  }

  void go_home(const Block& block) {
    const Point through = target(block, false);
    emit(block.line, StraightTraverse{through});
    Point home = through;
    for (int axis = 0; axis < 3; ++axis) {
      const bool all = !has_axis(block);
      if (all || block.word(axis_letters[static_cast<std::size_t>(axis)])) home[axis] = mm * numbered(home_parameter + axis);
      if (!(std::abs(home[axis]) <= largest_coordinate_m)) block.fail(0, "home is out of any machine's reach");
    }
    emit(block.line, StraightTraverse{home});
    at_m_ = home;
  }

  void motion(const Block& block, const Codes& codes) {
    const auto& written = codes[GGroup::motion];
    if (written) motion_ = static_cast<Motion>(written->tenths / 10);
    if (motion_ == Motion::none || !(has_axis(block) || written)) return;  // a bare G1 moves to where the tool is
    const Point to = target(block, codes.machine_coordinates);
    if (motion_ == Motion::traverse) {
      emit(block.line, StraightTraverse{to});
    } else if (motion_ == Motion::feed) {
      emit(block.line, StraightFeed{to, feed_.m_per_s(block, length(to - at_m_), spindle_.speed_rad_per_s)});
    } else {
      arc(block, to);
    }
    at_m_ = to;
  }

  void arc(const Block& block, const Point& to) {
    // first and second of the plane in the right-handed order about its axis; I, J, K belong to x, y, z
    const int first = (plane_axis_ + 1) % 3, second = (plane_axis_ + 2) % 3;
    constexpr std::array<char, 3> centre_letters{'i', 'j', 'k'};
    const auto& off_plane = block.word(centre_letters[static_cast<std::size_t>(plane_axis_)]);
    if (off_plane) block.fail(off_plane->at, "an offset of the centre out of the arc's plane");
    const auto& a = block.word(centre_letters[static_cast<std::size_t>(first)]);
    const auto& b = block.word(centre_letters[static_cast<std::size_t>(second)]);
    const auto& r = block.word('r');
    if (r && (a || b)) block.fail(r->at, "an arc with both a radius and a centre");
    if (!r && !a && !b) block.fail(0, "an arc without a radius (R) or a centre (I, J, K)");
    const PlanarPoint from{at_m_[first], at_m_[second]}, end{to[first], to[second]};
    const bool clockwise = motion_ == Motion::clockwise;
    const auto& tolerance = unit_m_ == inch ? inch_arc_tolerance : metric_arc_tolerance;
    const ArcResult result = r ? arc_from_radius(from, end, r->value * unit_m_, clockwise, turns(block), tolerance)
                               : arc_from_centre(from, end, {a ? a->value * unit_m_ : 0.0, b ? b->value * unit_m_ : 0.0},
                                                 clockwise, turns(block), tolerance);
    const std::size_t at = r ? r->at : a ? a->at : b->at;
    if (!result.problem.empty()) block.fail(at, result.problem);
    ArcFeed command{to, at_m_, plane_axis_, result.arc.sweep_rad, 0.0};
    command.centre_m[first] = result.arc.centre.first;
    command.centre_m[second] = result.arc.centre.second;
    const double radius = std::hypot(from.first - result.arc.centre.first, from.second - result.arc.centre.second);
    if (!(radius <= largest_coordinate_m)) block.fail(at, "the arc's radius is beyond any machine");
    const double length_m = std::hypot(radius * result.arc.sweep_rad, to[plane_axis_] - at_m_[plane_axis_]);
    command.feed_m_per_s = feed_.m_per_s(block, length_m, spindle_.speed_rad_per_s);
    emit(block.line, command);
  }

  static int turns(const Block& block) {
    const auto& p = block.word('p');
    if (!p) return 1;
    const double whole = std::round(p->value);
    if (whole < 1.0 || whole > 1000.0 || std::abs(whole - p->value) > 1e-4) block.fail(p->at, "expected 1 to 1000 turns");
    return static_cast<int>(whole);
  }

  void set_parameter(const Block::Setting& setting) {
    if (setting.name.number > 0) {
      parameters_.numbered[static_cast<std::size_t>(setting.name.number)] = setting.value;
    } else {
      parameters_.named[setting.name.name] = setting.value;
    }
  }

  void stopping(const Block& block, const Codes& codes) {
    const auto& code = codes[MGroup::stopping];
    if (!code) return;
    if (code->tenths <= 10) {
      emit(block.line, ProgramStop{code->tenths == 10});
      return;
    }
    spindle_off(block);
    if (coolant_.mist || coolant_.flood) emit(block.line, SetCoolant{});
    emit(block.line, ProgramEnd{});
    ended_ = true;
  }

  Parameters parameters_;
  bool block_delete_;
  Program program_;
  bool ended_ = false;

  Point at_m_;      // machine coordinates
  Point offset_m_;  // of the coordinate system in force
  double unit_m_ = mm;
  int plane_axis_ = 2;
  bool incremental_ = false;
  Motion motion_ = Motion::traverse;
  Feed feed_;
  SetSpindle spindle_;
  SetCoolant coolant_;
  int tool_ = 0;
};

}  // namespace

Program interpret(std::string_view text, const InterpreterSettings& settings) {
  return Interpreter(settings).run(text);
}

}  // namespace feedtwin::controllers::gcode
