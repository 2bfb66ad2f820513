#include "controllers/gcode/planner.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::controllers::gcode {

namespace {
/// Slower corners stop.
constexpr double least_corner_speed_m_per_s = 1e-4;
/// Shorter moves are none: below what double precision resolves along a curve.
constexpr double least_length_m = 1e-9;
}  // namespace

class Planner {
 public:
  Planner(const PlannerSettings& settings)
      : settings_(settings), at_m_(settings.start_m), tolerance_m_(settings.blend_tolerance_m) {
    out_.start_m_ = settings.start_m;
  }

  Trajectory run(const Program& program) {
    for (const Command& command : program)
      std::visit([&](const auto& action) { take(command.line, action); }, command.action);
    finish_run();
    out_.duration_s_ = time_s_;
    out_.end_m_ = at_m_;
    return std::move(out_);
  }

 private:
  /// The junction behind a segment of the run that is being collected.
  struct Junction {
    CornerBlend blend;
    double speed_m_per_s = 0.0;
  };

  void take(std::size_t line, const StraightTraverse& move) {
    if (!last_was_rapid_) finish_run();  // a rapid never cuts a corner that a feed move made
    last_was_rapid_ = true;
    add(line, Segment::straight(at_m_, move.to_m), 0.0);
  }
  void take(std::size_t line, const StraightFeed& move) {
    if (last_was_rapid_) finish_run();
    last_was_rapid_ = false;
    add(line, Segment::straight(at_m_, move.to_m), move.feed_m_per_s);
  }
  void take(std::size_t line, const ArcFeed& move) {
    if (last_was_rapid_) finish_run();
    last_was_rapid_ = false;
    add(line, Segment::arc(at_m_, move), move.feed_m_per_s);
  }
  void take(std::size_t line, const Dwell& dwell) {
    finish_run();
    out_.events_.push_back({time_s_, line, Action{dwell}});
    time_s_ += dwell.duration_s;
  }
  void take(std::size_t /*line*/, const SetPathMode& mode) {
    path_mode_ = mode.mode;
    tolerance_m_ = mode.mode == PathMode::exact_path ? exact_path_tolerance_m
                   : mode.tolerance_m > 0.0          ? mode.tolerance_m
                                                     : settings_.blend_tolerance_m;
  }
  template <class Switching>
  void take(std::size_t line, const Switching& action) {
    finish_run();
    out_.events_.push_back({time_s_, line, Action{action}});
  }

  void add(std::size_t line, Segment segment, double feed_m_per_s) {
    at_m_ = segment.to_m();
    if (segment.length_m() < least_length_m) return;
    segment.line = line;
    segment.rapid = feed_m_per_s == 0.0;
    segment.feed_m_per_s = feed_m_per_s * settings_.feed_override;
    constexpr double as_fast_as_axes_go = 1e6;
    limits_.push_back(segment.limits(segment.rapid ? as_fast_as_axes_go : segment.feed_m_per_s, settings_.limits));
    if (limits_.size() > 1) junctions_.push_back(join(out_.segments_.back(), segment));
    out_.segments_.push_back(segment);
  }

  Junction join(const Segment& before, const Segment& after) {
    if (path_mode_ == PathMode::exact_stop) return {};
    const CornerBlend blend = blend_within(before, after, tolerance_m_);
    if (blend.cut_m() == 0.0) return {};
    const double speed = std::min({blend.speed_limit_m_per_s(settings_.limits), limits_[limits_.size() - 2].speed_m_per_s,
                                   limits_.back().speed_m_per_s});
    if (speed < least_corner_speed_m_per_s || stopping_is_faster(before, after, blend, speed)) return {};
    out_.largest_blend_deviation_m_ = std::max(out_.largest_blend_deviation_m_, blend.deviation_m(before, after));
    return {blend, speed};
  }

  /// At a sharp corner and a narrow tolerance, a stop on the path itself can take less time than the way round, whose ends
  /// ask for zero acceleration. Judged over the adjoining halves of the two segments.
  [[nodiscard]] bool stopping_is_faster(const Segment& before, const Segment& after, const CornerBlend& blend,
                                        double speed_m_per_s) const {
    double stop_s = 0.0, round_s = blend.duration_s(speed_m_per_s);
    const auto judge = [&](const Segment& segment, const MoveLimits& limits) {
      const double half_m = 0.5 * segment.length_m();
      const double top = std::max(speed_m_per_s, reachable_speed_m_per_s(0.0, half_m, limits));
      const auto taken_s = [&](double from, double distance_m) {
        const SpeedRamp ramp(from, top, limits);
        return ramp.duration_s() + (distance_m - ramp.distance_m()) / top;
      };
      stop_s += taken_s(0.0, half_m);
      round_s += taken_s(speed_m_per_s, half_m - blend.cut_m());
    };
    judge(before, limits_[limits_.size() - 2]);
    judge(after, limits_.back());
    return stop_s < round_s;
  }

  [[nodiscard]] double core_length_m(std::size_t i) const {
    double length_m = out_.segments_[first_ + i].length_m();
    if (i > 0) length_m -= junctions_[i - 1].blend.cut_m();
    if (i < junctions_.size()) length_m -= junctions_[i].blend.cut_m();
    return length_m;
  }

  /// Ends the run of moves without a forced stop and times it, from rest to rest.
  void finish_run() {
    const std::size_t count = limits_.size();
    for (std::size_t i = count; i-- > 1;) {  // backwards: what can still be braked from
      const double next = i < junctions_.size() ? junctions_[i].speed_m_per_s : 0.0;
      slow_down(i - 1, reachable_speed_m_per_s(next, core_length_m(i), limits_[i]));
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {  // forwards: what can be reached
      const double last = i > 0 ? junctions_[i - 1].speed_m_per_s : 0.0;
      slow_down(i, reachable_speed_m_per_s(last, core_length_m(i), limits_[i]));
    }
    for (std::size_t i = 0; i < count; ++i) time_segment(i);
    first_ = out_.segments_.size();
    limits_.clear();
    junctions_.clear();
  }

  void slow_down(std::size_t junction, double speed_m_per_s) {
    junctions_[junction].speed_m_per_s = std::min(junctions_[junction].speed_m_per_s, speed_m_per_s);
  }

  void time_segment(std::size_t i) {
    const double from = i > 0 ? junctions_[i - 1].speed_m_per_s : 0.0;
    const bool last = i >= junctions_.size();
    const double to = last ? 0.0 : junctions_[i].speed_m_per_s;
    Trajectory::Piece piece;
    piece.segment = first_ + i;
    piece.from_m = i > 0 ? junctions_[i - 1].blend.cut_m() : 0.0;
    piece.profile = SpeedProfile(from, to, core_length_m(i), limits_[i]);
    push(piece, piece.profile.duration_s());
    if (last || junctions_[i].blend.cut_m() == 0.0) return;
    Trajectory::Piece corner;
    corner.segment = first_ + i;
    corner.blend = static_cast<int>(out_.blends_.size());
    corner.blend_speed_m_per_s = to;
    out_.blends_.push_back(junctions_[i].blend);
    push(corner, junctions_[i].blend.duration_s(to));
  }

  void push(Trajectory::Piece& piece, double duration_s) {
    piece.start_s = time_s_;
    piece.duration_s = duration_s;
    time_s_ += duration_s;
    out_.pieces_.push_back(piece);
  }

  PlannerSettings settings_;
  Trajectory out_;
  Point at_m_;
  double time_s_ = 0.0;
  bool last_was_rapid_ = false;
  PathMode path_mode_ = PathMode::continuous;
  double tolerance_m_;

  std::size_t first_ = 0;            // segment of the run that is being collected
  std::vector<MoveLimits> limits_;   // of its segments
  std::vector<Junction> junctions_;  // between them
};

Trajectory plan(const Program& program, const PlannerSettings& settings) {
  return Planner(settings).run(program);
}

}  // namespace feedtwin::controllers::gcode
