#pragma once
// A force that acts in a part of each run, as a process does while the tool is in the cut.

#include <optional>
#include <utility>
#include <vector>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// Since the run began; all of the run where it does not end after it starts.
struct Window {
  double start_s = 0.0, end_s = 0.0;
  [[nodiscard]] bool whole() const { return end_s <= start_s; }
};

/// Its part of the time about each sample of a run.
[[nodiscard]] Vector covered(const Window& window, Index samples, double sample_s);

/// Rows from, and up to which, series that stand beside each other hold more of a line than all of them do: by a third and
/// so much; none where they do not.
[[nodiscard]] std::optional<std::pair<Index, Index>> part_of_line(const std::vector<Vector>& rows, double radians_per_row,
                                                                  double stronger_by);

/// Where in each run a line acts: the part in which the whitened rows of the table's force hold most of it; all of a run
/// where that is as good.
[[nodiscard]] std::vector<Window> windows_of_line(const InverseModel& model, const Vector& white, double frequency_Hz);

/// Of an effect that has windows, see Hypothesis::first_window; any further run shares the last one's.
[[nodiscard]] Window window_of_run(const Hypothesis& hypothesis, std::span<const double> q, std::size_t run);
void set_windows(const Hypothesis& hypothesis, std::span<double> q, std::span<const Window> windows);
/// Does it act in a part of any run alone?
[[nodiscard]] bool windowed(const Active& active);

}  // namespace feedtwin::tools::diagnosis
