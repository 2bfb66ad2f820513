#include "tools/diagnose/windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tools/median.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index envelope_reach = 12,
                envelope_rows = 2 * envelope_reach + 1;  // rows that an envelope's value is made of, by a Hann window: 0.1 s
constexpr double rows_apart = envelope_rows / 1.5;       // rows between values that know nothing of each other
// of the logarithm of the values in a run about four times as much, for each of two edges
constexpr double window_costs = 36.0;
constexpr Index least_rows = 25;  // a tenth of a second: less is no cut

/// Rows moved down by a frequency and averaged: A e^(i phase) where they hold a line A cos(w k - phase), whatever slow or
/// other mismatch they hold too.
Eigen::VectorXcd envelope(const Vector& rows, double radians_per_row) {
  const auto hann = [](Index i) {
    return (1.0 + std::cos(std::numbers::pi * static_cast<double>(i) / (envelope_reach + 1))) / (envelope_reach + 1);
  };
  Eigen::VectorXcd moved(rows.size()), smooth = Eigen::VectorXcd::Zero(rows.size());
  for (Index k = 0; k < rows.size(); ++k) moved[k] = rows[k] * std::polar(1.0, radians_per_row * static_cast<double>(k));
  for (Index k = 0; k < rows.size(); ++k)
    for (Index i = -std::min(envelope_reach, k); i <= std::min(envelope_reach, rows.size() - 1 - k); ++i)
      smooth[k] += hann(i) * moved[k + i];
  return smooth;
}

/// A line in one equation's rows, and how noisy its envelope is beside it.
struct Line {
  Eigen::VectorXcd envelope;
  double noise;            ///< mean square
  std::vector<bool> told;  ///< rows that tell of it: where friction holds the table nothing shows

  [[nodiscard]] static Line in(const Vector& rows, std::vector<bool> told, double radians_per_row, double row_s) {
    constexpr double beside_Hz = 25.0;  // beyond the window's main lobe
    std::vector<double> squares;
    for (const double off_Hz : {-beside_Hz, beside_Hz}) {
      const auto other = diagnosis::envelope(rows, radians_per_row + 2.0 * std::numbers::pi * off_Hz * row_s);
      for (Index k = 0; k < other.size(); ++k)
        if (told[static_cast<std::size_t>(k)]) squares.push_back(std::norm(other[k]));
    }
    const double noise = squares.empty() ? 1.0 : median_of(std::move(squares)) / std::numbers::ln2 + 1e-300;
    return {diagnosis::envelope(rows, radians_per_row), noise, std::move(told)};
  }
  [[nodiscard]] std::complex<double> mean(const std::vector<bool>& in_cut) const {
    std::complex<double> sum = 0.0;
    double rows = 1e-300;
    for (std::size_t k = 0; k < in_cut.size(); ++k)
      if (in_cut[k] && told[k]) sum += envelope[static_cast<Index>(k)], rows += 1.0;
    return sum / rows;
  }
};

/// What each row gains from its lines where they act: the fall of its square, in deviations of the noise.
Vector gains(const std::vector<Line>& lines, const std::vector<bool>& in_cut) {
  Vector gain = Vector::Zero(static_cast<Index>(in_cut.size()));
  for (const auto& line : lines) {
    const auto mean = line.mean(in_cut);
    const double per_row = 2.0 / (line.noise * rows_apart);
    for (Index k = 0; k < gain.size(); ++k)
      if (line.told[static_cast<std::size_t>(k)])
        gain[k] += per_row * (2.0 * (line.envelope[k] * std::conj(mean)).real() - std::norm(mean));
  }
  return gain;
}

/// The rows in the cut that gain most together, each change of state at its price (Viterbi, two states).
std::vector<bool> best_parts(const Vector& gain) {
  constexpr double edge_costs = 0.5 * window_costs;
  const auto rows = static_cast<std::size_t>(gain.size());
  std::vector<std::array<bool, 2>> from_in(rows);
  std::array<double, 2> best{0.0, 0.0};  // out of the cut, in it; a run may begin in either
  for (std::size_t k = 0; k < rows; ++k) {
    from_in[k] = {best[1] - edge_costs > best[0], best[1] > best[0] - edge_costs};
    best = {std::max(best[0], best[1] - edge_costs), std::max(best[1], best[0] - edge_costs) + gain[static_cast<Index>(k)]};
  }
  std::vector<bool> in_cut(rows);
  bool in = best[1] > best[0];
  for (std::size_t k = rows; k-- > 0; in = from_in[k][in ? 1 : 0]) in_cut[k] = in;
  return in_cut;
}

/// Rows from and to, in order; the longest where there are too many.
std::vector<std::pair<Index, Index>> parts_of(const std::vector<bool>& in_cut) {
  std::vector<std::pair<Index, Index>> parts;
  for (std::size_t k = 0; k < in_cut.size(); ++k) {
    if (!in_cut[k]) continue;
    if (k == 0 || !in_cut[k - 1]) parts.emplace_back(static_cast<Index>(k), 0);
    parts.back().second = static_cast<Index>(k) + 1;
  }
  const auto length = [](const auto& part) { return part.second - part.first; };
  std::erase_if(parts, [&](const auto& part) { return length(part) < least_rows; });
  while (parts.size() > most_windows) parts.erase(std::ranges::min_element(parts, {}, length));
  return parts;
}

/// The line's phase over the run is its strongest half second's: from there the parts are found and it is fitted to them, in
/// turn.
std::vector<bool> where_it_acts(const std::vector<Line>& lines, Index rows, Index strongest_rows) {
  constexpr int turns = 8;
  std::vector<bool> best;
  double most = -1e300;
  for (Index from = 0; from + strongest_rows <= rows; from += strongest_rows) {
    std::vector<bool> in_cut(static_cast<std::size_t>(rows));
    std::fill_n(in_cut.begin() + from, strongest_rows, true);
    const Vector gain = gains(lines, in_cut);
    const double here = gain.segment(from, strongest_rows).sum();
    if (here > most) most = here, best = in_cut;
  }
  for (int i = 0; i < turns && !best.empty(); ++i) {
    auto next = best_parts(gains(lines, best));
    if (next == best || std::ranges::find(next, true) == next.end()) break;
    best = std::move(next);
  }
  return best;
}

double gained(const std::vector<Line>& lines, const std::vector<bool>& in_cut) {
  const Vector gain = gains(lines, in_cut);
  double sum = 0.0;
  for (std::size_t k = 0; k < in_cut.size(); ++k) sum += in_cut[k] ? gain[static_cast<Index>(k)] : 0.0;
  return sum;
}

/// Rows whose envelope is made of settled ones alone.
std::vector<bool> rows_that_tell(const InverseModel& model, const Segment& s) {
  std::vector<bool> tell(static_cast<std::size_t>(s.size), true);
  for (Index k = 0; k < s.size; ++k)
    if (!model.settled(s.start + k))
      std::fill(tell.begin() + std::max<Index>(0, k - envelope_reach),
                tell.begin() + std::min(s.size, k + envelope_reach + 1), false);
  return tell;
}

Windows windows_in(const InverseModel& model, const Vector& white, std::size_t run, double frequency_Hz) {
  const double sample_s = model.tracks()[run].sample_s, row_s = model.tracks()[run].row_s();
  std::vector<Line> lines;
  Index first_sample = 0, rows = 0;
  for (const auto& s : model.segments()) {
    if (s.run != run || !model.equations()[s.equation].guide || s.size == 0) continue;
    rows = lines.empty() ? s.size : std::min(rows, s.size);
    lines.push_back(Line::in(white.segment(s.start, s.size), rows_that_tell(model, s),
                             2.0 * std::numbers::pi * frequency_Hz * row_s, row_s));
    first_sample = model.sample_of(s, 0);
  }
  const std::vector<bool> all(static_cast<std::size_t>(rows), true),
      in_cut = where_it_acts(lines, rows, std::lround(0.5 / row_s));
  const auto parts = parts_of(in_cut);
  const double costs = window_costs * static_cast<double>(parts.size());
  if (parts.empty() || gained(lines, in_cut) - costs < gained(lines, all)) return {};
  const double begun_s = static_cast<double>(first_sample) * sample_s - 0.5 * row_s;
  Windows windows;
  for (const auto& [from, to] : parts)
    windows.push_back({begun_s + static_cast<double>(from) * row_s, begun_s + static_cast<double>(to) * row_s});
  return windows;
}

}  // namespace

Vector covered(std::span<const Window> windows, double ramp_s, Index samples, double sample_s) {
  Vector share = Vector::Zero(samples);
  const double over_s = std::max(ramp_s, sample_s);
  for (const Window& window : windows)
    for (Index k = 0; k < samples; ++k) {
      const double now_s = static_cast<double>(k) * sample_s;
      share[k] += std::clamp(std::min(now_s - window.start_s, window.end_s - now_s) / over_s + 0.5, 0.0, 1.0);
    }
  return share;
}

double share_at_one_speed(const std::vector<Track>& runs, std::span<const Windows> windows) {
  constexpr double about_s = 0.05, change = 0.03, alike = 1.1;
  std::vector<double> steady_m_per_s;
  std::size_t all = 0;
  for (std::size_t run = 0; run < windows.size(); ++run) {
    const Track& track = runs[run];
    const Vector& v = track.centred_m_per_s;
    const Index about = std::lround(about_s / track.sample_s);
    for (const Window& window : windows[run])
      for (Index k = std::max(about, static_cast<Index>(window.start_s / track.sample_s));
           k < std::min(track.size - about, static_cast<Index>(window.end_s / track.sample_s)); ++k) {
        if (std::abs(v[k]) < standstill_m_per_s) continue;
        ++all;
        if (std::abs(v[k + about] - v[k - about]) < change * std::abs(v[k])) steady_m_per_s.push_back(std::abs(v[k]));
      }
  }
  std::ranges::sort(steady_m_per_s);
  std::size_t most = 0, slowest = 0;
  for (std::size_t k = 0; k < steady_m_per_s.size(); ++k) {
    while (steady_m_per_s[k] > alike * steady_m_per_s[slowest]) ++slowest;
    most = std::max(most, k + 1 - slowest);
  }
  return all == 0 ? 0.0 : static_cast<double>(most) / static_cast<double>(all);
}

std::vector<Windows> windows_of_line(const InverseModel& model, const Vector& white, double frequency_Hz) {
  std::vector<Windows> windows;
  for (std::size_t run = 0; run < std::min(line_runs, model.tracks().size()); ++run)
    windows.push_back(windows_in(model, white, run, frequency_Hz));
  return windows;
}

Windows windows_of_run(std::size_t first_window, std::span<const double> q, std::size_t run) {
  const std::size_t at = first_window + 2 * most_windows * std::min(run, line_runs - 1);
  Windows windows;
  for (std::size_t i = at; first_window > 0 && i + 1 < std::min(q.size(), at + 2 * most_windows); i += 2)
    if (const Window window{q[i], q[i + 1]}; !window.whole()) windows.push_back(window);
  return windows;
}

void set_windows(std::size_t first_window, std::span<double> q, std::span<const Windows> windows) {
  std::ranges::fill(q.subspan(first_window, window_parameters), 0.0);
  for (std::size_t run = 0; run < std::min(line_runs, windows.size()); ++run)
    for (std::size_t i = 0; i < std::min(most_windows, windows[run].size()); ++i) {
      const std::size_t at = first_window + 2 * (most_windows * run + i);
      q[at] = windows[run][i].start_s, q[at + 1] = windows[run][i].end_s;
    }
}

bool windowed(std::size_t first_window, std::span<const double> q) {
  for (std::size_t run = 0; run < line_runs; ++run)
    if (!windows_of_run(first_window, q, run).empty()) return true;
  return false;
}

}  // namespace feedtwin::tools::diagnosis
