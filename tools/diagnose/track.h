#pragma once
// One recorded run as the inverse model sees it: everything at the samples, forces as forces at the table.
//
// The command is held for one sample, so over two samples the momentum balance is exact in the form
//   M (x[k+1] - 2 x[k] + x[k-1]) / h^2 = (u[k-1] + u[k]) / 2 - mean of the resisting force over the two samples,
//   triangularly weighted
// and no half-sample delay enters.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plant/parameters.h"
#include "tools/identify/setpoint.h"
#include "tools/identify/sliding.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools::diagnosis {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

/// Sub-steps a sample along which friction is followed.
inline constexpr int path_substeps = 4;

/// Between two rows of a force equation: but for lines, what acts is below a tenth of the sample rate.
inline constexpr Index usual_samples_a_row = 4;

/// Above it, rows are blind to a line: 100 Hz by the usual ones at 1 kHz.
[[nodiscard]] inline double highest_line_Hz(Index samples_a_row, double sample_s) {
  return 0.4 / (static_cast<double>(samples_a_row) * sample_s);
}

/// Readings of a power meter that shows means over windows.
struct MeterWindows {
  Index length = 0;         ///< samples a window
  bool held = false;        ///< the meter's own; otherwise means that we took
  bool of_command = false;  ///< computed from the command: nothing that acts between it and the shaft shows
  std::vector<Index> starts;
  std::vector<double> power_W;
};

/// How much of the command's jump each sensor shows at once, of what one body would show it.
struct JumpShares {
  double torque = 1.0, force = 1.0;  ///< negative: it is read before the jump
  bool before_command = false;       ///< both sensors are read before the row's command sets in
};

struct Track {
  std::string name;     ///< of the file
  std::size_t run = 0;  ///< among those of the case
  double sample_s = 1e-3;
  Index size = 0;
  Index samples_a_row = usual_samples_a_row;
  Vector command_N;         ///< mean of the command before and after the sample
  Vector held_N;            ///< command in force after the sample
  Vector shown_m;           ///< position as it was recorded
  Vector position_m;        ///< lightly smoothed
  Vector velocity_m_per_s;  ///< mean over the sample that follows
  Vector centred_m_per_s;   ///< velocity at the sample
  Setpoints setpoints;      ///< what the drive was told to reach
  Vector steady_m_per_s;    ///< velocity_m_per_s, none where only the encoder's grid moves
  Vector motor_direction;   ///< tanh(velocity / standstill): how much of the motor's Coulomb friction acts, and which way
  Vector acceleration_m_per_s2;
  Vector path_m_per_s;  ///< velocities of the sub-steps, path_substeps a sample
  /// The table's own motion: the linear scale's where there is one, otherwise the motor's.
  Vector table_position_m, table_velocity_m_per_s, table_acceleration_m_per_s2, table_path_m_per_s;
  Vector since_reversal_s;  ///< time since the direction changed
  Vector dwell_s;           ///< length of the last standstill, from its end on
  /// Command that sets in at the sample beyond its mean about it: the sensors read with it, the balance without.
  Vector half_step_N;
  JumpShares jump_shares;
  Vector torque_sensor_N;  ///< empty where not recorded; likewise below
  Vector force_sensor_N;
  Vector slip_m;  ///< linear scale less motor encoder
  MeterWindows meter;
  Vector metered_m_per_s;  ///< velocity that the power meter saw under the command of a sample, not smoothed
  Vector metered_at_m;     ///< where it saw it

  [[nodiscard]] double row_s() const { return static_cast<double>(samples_a_row) * sample_s; }
  [[nodiscard]] double highest_line_Hz() const { return diagnosis::highest_line_Hz(samples_a_row, sample_s); }
};

[[nodiscard]] Track make_track(const Recording& recording, const plant::AxisParameters& axis);
/// What a case's runs have in common.
struct TrackSettings {
  JumpShares jump_shares;
  Index samples_a_row = usual_samples_a_row;
};
/// Of the runs of a case, each with its place among them.
[[nodiscard]] std::vector<Track> make_tracks(const std::vector<Recording>& recordings, const plant::AxisParameters& axis,
                                             const TrackSettings& settings = {});

/// From where to where the axis came in any of the runs.
struct Travel {
  double low_m = 1e300, high_m = -1e300;
  [[nodiscard]] double length_m() const { return high_m - low_m; }
};
/// @param position of the motor, or of the table
[[nodiscard]] Travel travel_of(const std::vector<Track>& runs, Vector Track::* position);

/// Mean over the sample before and the sample after: from forces over a sample to forces about it.
[[nodiscard]] Vector about_sample(const Vector& after);

}  // namespace feedtwin::tools::diagnosis
