#pragma once
// How a recording's power meter reads: held for a window, the mean of that window (of instants or of all time), of this
// row's tick or of the one before.

#include <array>
#include <span>
#include <vector>

#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// What a drive's power may be made of at an instant, in no unit: 1, |v| and v^2 forth and back, force squared, work, and
/// the work given back, last (Eqs. 7 and 11, the copper loss that they leave out, and what a drive may burn).
using DrivePowers = std::array<double, 8>;
[[nodiscard]] DrivePowers drive_powers(double force_N, double velocity_m_per_s);

/// The rows at which a metered power (held for many rows) is new, and the number of ticks that it is the mean of; window 1
/// and every row where the power is not held.
struct MeteredPower {
  std::vector<std::size_t> rows;
  std::size_t window = 1;  ///< ticks that a reading is the mean of; longer than between readings where windows overlap
  std::size_t delay = 0;   ///< ticks between the window's last and the row: 0 or 1

  /// The first of the ticks that row shows the mean of; the last is `window` - 1 later.
  [[nodiscard]] std::size_t first_tick(std::size_t row) const { return row + 1 - window - delay; }
};

/// Ticks of a window that spans so many readings.
[[nodiscard]] std::size_t ticks_of_window(std::size_t ticks_between, double readings);

/// @param expected_window ticks, for a meter that shows too few different readings to tell its own; 0: unknown
[[nodiscard]] MeteredPower metered_rows(std::span<const double> power_W, std::size_t expected_window = 0);
/// Of a recording, which may have no power: with the window that the axis file states and the recording's delay.
[[nodiscard]] MeteredPower metered_rows(const Recording& recording, const plant::AxisParameters& axis);

/// How the meter that made these recordings reads: as the recorded command and motion explain its readings best, where that
/// is clearly better than the means over instants of this row's window.
[[nodiscard]] MeterHabit meter_habit(std::span<const Recording> recordings, const plant::AxisParameters& axis);

/// What the error of a reading is in proportion to, among others of its run whose rms this is; alike: 1 in every run.
[[nodiscard]] double error_scale_W(double reading_W, double rms_W, bool errors_alike);

/// A simulated power as the recording's meter would show it, row by row.
[[nodiscard]] std::vector<double> as_metered(std::span<const double> power_W, const MeteredPower& meter);

}  // namespace feedtwin::tools
