#pragma once
// A gain of the force sensor that the table's numbers hold. The sensor reads g (m a + F): with mass and friction of the
// table all g times as large, and with what is too much of them taken from the screw's, every channel is as it was, so no
// fit finds the gain. The axis file tells: numbers that are known to a tenth each are not all off by the same share.

#include <functional>
#include <optional>
#include <string_view>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// What the table's mass and friction (all of it, at the speeds of the runs, both ways) have in common.
struct CommonShift {
  double factor = 1.0;           ///< of the axis file's, the geometric mean of both
  double fall = 0.0;             ///< of the squared deviations from the file, in tolerances, without it
  bool of_all_together = false;  ///< beyond a tolerance, the mass as well, and without it they are as the file has them

  /// May it come of a sensor with this gain? Polished, a gain may end far from it, for what else the model simplifies.
  [[nodiscard]] bool stands_for(double gain) const;
};
[[nodiscard]] CommonShift common_shift(const Fitter& fitter, const plant::AxisParameters& axis);

/// The axis with so many times less of the table, and with what that takes given to the screw: the same to the motor,
/// but for the damping of the bristles, of which the screw may have none to give.
[[nodiscard]] plant::AxisParameters with_table_less(plant::AxisParameters axis, double times);

/// Names the gain where the numbers have such a shift and the runs are nearly as likely with numbers near nominal and a gain
/// of about that size.
/// @return the fit's model as the closed loop has it where the gain was added; otherwise as it was given
std::optional<Ruling> ask_for_gain_in_numbers(const ForwardModel& forward, const Fitter& fitter, SearchResult& found,
                                              Fit& fit, std::optional<Ruling> settled,
                                              const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
