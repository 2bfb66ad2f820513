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

struct Part {
  Index from, to;
  double power;
};

/// Rows that hold most of the line: on a grid of edges, which then move by ever less.
Part strongest_part(const LineSums& sums) {
  const Index all = sums.rows();
  Part best{0, all, sums.power(0, all)};
  const auto take_if_stronger = [&](Index from, Index to) {
    const double power = sums.power(from, to);
    if (power > best.power) best = {from, to, power};
  };
  Index step = 1 + all / most_edges;
  for (Index from = 0; from < all; from += step)
    for (Index to = from + least_rows; to <= all; to += step) take_if_stronger(from, to);
  for (; step > 0; step /= 2)
    for (const Index moved : {-step, step}) {
      take_if_stronger(std::clamp<Index>(best.from + moved, 0, all), best.to);
      take_if_stronger(best.from, std::clamp<Index>(best.to + moved, 0, all));
    }
  return best;
}

Window window_of_line(const InverseModel& model, const Vector& white, std::size_t run, double frequency_Hz) {
  // of unit noise a line's power has a mean of one, the strongest of many parts a few more
  constexpr double times_as_strong = 1.3, stronger_by = 12.0;
  std::vector<Vector> rows;
  Index first_sample = 0;
  for (const auto& s : model.segments()) {
    if (s.run != run || !model.equations()[s.equation].guide || s.size == 0) continue;
    rows.emplace_back(white.segment(s.start, s.size));
    first_sample = model.sample_of(s, 0);
  }
  const double row_s = InverseModel::decimation * model.tracks()[run].sample_s;
  const LineSums sums(rows, 2.0 * std::numbers::pi * frequency_Hz * row_s);
  const Part part = strongest_part(sums);
  const double whole = sums.power(0, sums.rows());
  if (part.power < std::max(times_as_strong * whole, whole + stronger_by)) return {};
  const double begun_s = static_cast<double>(first_sample) * model.tracks()[run].sample_s - 0.5 * row_s;
  return {begun_s + static_cast<double>(part.from) * row_s, begun_s + static_cast<double>(part.to) * row_s};
}

}  // namespace

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

Window window_of_run(std::size_t first_window, std::span<const double> q, std::size_t run) {
  const std::size_t at = first_window + 2 * std::min(run, line_runs - 1);
  if (first_window == 0 || at + 1 >= q.size()) return {};
  return {q[at], q[at + 1]};
}

void set_windows(std::size_t first_window, std::span<double> q, std::span<const Window> windows) {
  for (std::size_t run = 0; run < line_runs; ++run) {
    const Window window = run < windows.size() ? windows[run] : Window{};
    q[first_window + 2 * run] = window.start_s;
    q[first_window + 2 * run + 1] = window.end_s;
  }
}

bool windowed(std::size_t first_window, std::span<const double> q) {
  for (std::size_t run = 0; run < line_runs; ++run)
    if (!window_of_run(first_window, q, run).whole()) return true;
  return false;
}

}  // namespace feedtwin::tools::diagnosis
