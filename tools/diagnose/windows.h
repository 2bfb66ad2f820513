#pragma once
// A force that acts in a part of each run, as a process does while the tool is in the cut.

#include <cstddef>
#include <span>
#include <vector>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// Since the run began; all of the run where it does not end after it starts.
struct Window {
  double start_s = 0.0, end_s = 0.0;
  [[nodiscard]] bool whole() const { return end_s <= start_s; }
};

/// Of one run, in order: a tool comes into the cut time and again. None: all of the run.
using Windows = std::vector<Window>;

/// As many as a run can have.
inline constexpr std::size_t most_windows = 8;
/// Working parameters that all of them take: start and end of each, run by run.
inline constexpr std::size_t window_parameters = line_runs * most_windows * 2;

/// Their part of the time about each sample of a run; over a ramp in proportion, half of it before each edge.
[[nodiscard]] Vector covered(std::span<const Window> windows, double ramp_s, Index samples, double sample_s);

/// Where in each run a line acts: the parts that together hold it, by more than its having no end would and than each of
/// their edges costs; otherwise all of a run.
[[nodiscard]] std::vector<Windows> windows_of_line(const InverseModel& model, const Vector& white, double frequency_Hz);

/// Of the samples in these parts, those at the steady speed, forth and back, that most of them have: there all that repeats
/// along the screw is a line too.
[[nodiscard]] double share_at_one_speed(const std::vector<Track>& runs, std::span<const Windows> windows);

/// Of an effect's working parameters, see Hypothesis::first_window; any further run shares the last one's.
[[nodiscard]] Windows windows_of_run(std::size_t first_window, std::span<const double> q, std::size_t run);
void set_windows(std::size_t first_window, std::span<double> q, std::span<const Windows> windows);
/// Does it act in a part of any run alone?
[[nodiscard]] bool windowed(std::size_t first_window, std::span<const double> q);
[[nodiscard]] inline bool windowed(const Active& active) {
  return windowed(active.hypothesis->first_window, active.q);
}

}  // namespace feedtwin::tools::diagnosis
