#include "tools/diagnose/windows.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index least_rows = 50, most_edges = 120;

/// Sums of rows times a line's phase up to each row.
class LineSums {
 public:
  LineSums(const std::vector<Vector>& series, double radians_per_row) {
    for (const auto& rows : series) {
      auto& sums = sums_.emplace_back(1, 0.0);
      for (Index k = 0; k < rows.size(); ++k)
        sums.push_back(sums.back() + rows[k] * std::polar(1.0, radians_per_row * static_cast<double>(k)));
      rows_ = sums_.size() == 1 ? rows.size() : std::min(rows_, rows.size());
    }
  }
  [[nodiscard]] Index rows() const { return rows_; }
  /// What a line in these rows would explain.
  [[nodiscard]] double power(Index from, Index to) const {
    if (to - from < least_rows) return 0.0;
    double power = 0.0;
    for (const auto& sums : sums_)
      power += std::norm(sums[static_cast<std::size_t>(to)] - sums[static_cast<std::size_t>(from)]);
    return power / static_cast<double>(to - from);
  }

 private:
  std::vector<std::vector<std::complex<double>>> sums_;
  Index rows_ = 0;
};

/// Rows that hold most of the line: on a grid of edges, which then move by ever less.
std::pair<Index, Index> strongest_part(const LineSums& sums) {
  std::pair<Index, Index> best{0, sums.rows()};
  const auto power = [&](const std::pair<Index, Index>& part) { return sums.power(part.first, part.second); };
  Index step = 1 + sums.rows() / most_edges;
  for (Index from = 0; from < sums.rows(); from += step)
    for (Index to = from + least_rows; to <= sums.rows(); to += step)
      if (sums.power(from, to) > power(best)) best = {from, to};
  for (; step > 0; step /= 2)
    for (const Index moved : {-step, step}) {
      const std::pair start{std::clamp<Index>(best.first + moved, 0, sums.rows()), best.second};
      if (power(start) > power(best)) best = start;
      const std::pair end{best.first, std::clamp<Index>(best.second + moved, 0, sums.rows())};
      if (power(end) > power(best)) best = end;
    }
  return best;
}

Window window_of_line(const InverseModel& model, const Vector& white, std::size_t run, double frequency_Hz) {
  constexpr double stronger_by =
      12.0;  // of unit noise a line's power has a mean of one, the strongest of many parts a few more
  std::vector<Vector> rows;
  Index first_sample = 0;
  for (const auto& s : model.segments()) {
    if (s.run != run || !model.equations()[s.equation].guide || s.size == 0) continue;
    rows.emplace_back(white.segment(s.start, s.size));
    first_sample = model.sample_of(s, 0);
  }
  const double row_s = InverseModel::decimation * model.tracks()[run].sample_s;
  const auto part = part_of_line(rows, 2.0 * std::numbers::pi * frequency_Hz * row_s, stronger_by);
  if (!part) return {};
  const double begun_s = static_cast<double>(first_sample) * model.tracks()[run].sample_s - 0.5 * row_s;
  return {begun_s + static_cast<double>(part->first) * row_s, begun_s + static_cast<double>(part->second) * row_s};
}

}  // namespace

std::optional<std::pair<Index, Index>> part_of_line(const std::vector<Vector>& rows, double radians_per_row,
                                                    double stronger_by) {
  constexpr double times_as_strong = 1.3;
  const LineSums sums(rows, radians_per_row);
  const auto [from, to] = strongest_part(sums);
  const double whole = sums.power(0, sums.rows());
  if (sums.power(from, to) < std::max(times_as_strong * whole, whole + stronger_by)) return {};
  return std::pair{from, to};
}

Vector covered(const Window& window, Index samples, double sample_s) {
  Vector share(samples);
  for (Index k = 0; k < samples; ++k) {
    const double middle = static_cast<double>(k) * sample_s, from = std::max(middle - 0.5 * sample_s, window.start_s),
                 to = std::min(middle + 0.5 * sample_s, window.end_s);
    share[k] = std::max(0.0, to - from) / sample_s;
  }
  return share;
}

std::vector<Window> windows_of_line(const InverseModel& model, const Vector& white, double frequency_Hz) {
  std::vector<Window> windows;
  for (std::size_t run = 0; run < std::min(line_runs, model.tracks().size()); ++run)
    windows.push_back(window_of_line(model, white, run, frequency_Hz));
  return windows;
}

Window window_of_run(const Hypothesis& hypothesis, std::span<const double> q, std::size_t run) {
  const std::size_t at = hypothesis.first_window + 2 * std::min(run, line_runs - 1);
  if (hypothesis.first_window == 0 || at + 1 >= q.size()) return {};
  return {q[at], q[at + 1]};
}

void set_windows(const Hypothesis& hypothesis, std::span<double> q, std::span<const Window> windows) {
  for (std::size_t run = 0; run < line_runs; ++run) {
    const Window window = run < windows.size() ? windows[run] : Window{};
    q[hypothesis.first_window + 2 * run] = window.start_s;
    q[hypothesis.first_window + 2 * run + 1] = window.end_s;
  }
}

bool windowed(const Active& active) {
  for (std::size_t run = 0; run < line_runs; ++run)
    if (!window_of_run(*active.hypothesis, active.q, run).whole()) return true;
  return false;
}

}  // namespace feedtwin::tools::diagnosis
