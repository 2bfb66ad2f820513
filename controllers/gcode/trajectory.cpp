#include "controllers/gcode/trajectory.h"

#include <algorithm>

namespace feedtwin::controllers::gcode {

Setpoint Trajectory::at(double time_s, Cursor& cursor) const noexcept FEEDTWIN_REALTIME {
  while (cursor.piece < pieces_.size() && time_s >= pieces_[cursor.piece].start_s + pieces_[cursor.piece].duration_s) {
    ++cursor.piece;
  }
  Setpoint setpoint;
  if (cursor.piece >= pieces_.size() || time_s < pieces_[cursor.piece].start_s) {
    // at rest: before a move, in a dwell, after the end
    if (cursor.piece == 0) {
      setpoint.at_m = start_m_;
    } else {
      setpoint.segment = pieces_[cursor.piece - 1].segment;
      setpoint.at_m = segments_[setpoint.segment].to_m();
      setpoint.along_m = segments_[setpoint.segment].length_m();
    }
    return setpoint;
  }
  const Piece& piece = pieces_[cursor.piece];
  const double since_s = time_s - piece.start_s;
  setpoint.moving = true;
  setpoint.segment = piece.segment;
  if (piece.blend >= 0) {
    const CornerBlend& blend = blends_[static_cast<std::size_t>(piece.blend)];
    const double u = std::min(1.0, since_s / piece.duration_s);
    const auto sample = blend.at(u, piece.blend_speed_m_per_s);
    setpoint.at_m = sample.at_m;
    setpoint.velocity_m_per_s = sample.velocity_m_per_s;
    setpoint.acceleration_m_per_s2 = sample.acceleration_m_per_s2;
    const double past_m = blend.cut_m() * (2.0 * u - 1.0);
    if (past_m >= 0.0) ++setpoint.segment;
    setpoint.along_m = past_m < 0.0 ? segments_[piece.segment].length_m() + past_m : past_m;
    return setpoint;
  }
  const Reference r = piece.profile.at(since_s);
  const CurvePoint p = segments_[piece.segment].at(piece.from_m + r.position_m);
  setpoint.along_m = piece.from_m + r.position_m;
  setpoint.at_m = p.at_m;
  setpoint.velocity_m_per_s = r.velocity_m_per_s * p.first;
  setpoint.acceleration_m_per_s2 =
      r.acceleration_m_per_s2 * p.first + (r.velocity_m_per_s * r.velocity_m_per_s) * p.second_per_m;
  return setpoint;
}

}  // namespace feedtwin::controllers::gcode
