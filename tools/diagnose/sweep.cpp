#include "tools/diagnose/sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double stretch_s = 2.0, lowest_Hz = 4.0, lowest_of_motion_Hz = 1.0;
constexpr double step_Hz_per_s = 0.5;  // moves the ends of a stretch by half a Hz
constexpr int most_steps = 120;
constexpr double much_of_stretch = 0.2, nearly_all_of_stretch = 0.5;  ///< share of its squares

/// The wave that is most of one stretch.
struct Wave {
  double middle_Hz = 0.0, rate_Hz_per_s = 0.0, amplitude_N = 0.0;
  double share = 0.0;  ///< of the stretch's squares
};

/// Rows of a stretch where the axis has settled, fading in and out.
struct Stretch {
  Vector values, weights;
  double row_s;
};

/// The likeliest linear sweep: the rows against each rate, and what is left of it is a line.
Wave strongest(const Stretch& stretch, double from_Hz) {
  const Index n = stretch.values.size();
  const auto length = static_cast<Index>(std::bit_ceil(static_cast<std::size_t>(2 * n)));
  const double per_bin_Hz = 1.0 / (static_cast<double>(length) * stretch.row_s);
  const auto first = static_cast<Index>(std::ceil(from_Hz / per_bin_Hz)), last = 9 * length / 20;
  Eigen::FFT<double> fft;
  Eigen::VectorXcd against = Eigen::VectorXcd::Zero(length), spectrum;
  double most = 0.0;
  Wave best;
  for (int step = -most_steps; step <= most_steps; ++step) {
    const double rate = step * step_Hz_per_s;
    for (Index k = 0; k < n; ++k) {
      const double t_s = (static_cast<double>(k) - 0.5 * static_cast<double>(n)) * stretch.row_s;
      against[k] = std::polar(stretch.values[k], -std::numbers::pi * rate * t_s * t_s);
    }
    fft.fwd(spectrum, against);
    Index at = 0;
    const double power = spectrum.cwiseAbs2().segment(first, last - first).maxCoeff(&at);
    if (power > most) most = power, best.middle_Hz = per_bin_Hz * static_cast<double>(first + at), best.rate_Hz_per_s = rate;
  }
  const double weights = stretch.weights.sum(), squares = stretch.values.squaredNorm();
  best.amplitude_N = 2.0 * std::sqrt(most) / weights;
  best.share = 0.5 * best.amplitude_N * best.amplitude_N * stretch.weights.squaredNorm() / squares;
  return best;
}

/// Is it much of its stretch, at a frequency that moves?
bool moves(const Wave& wave) {
  // beside a plain regression of command on motion no axis of 163 cases of two generators had two such pairs in all its
  // runs; one that swept had 22 of 22
  constexpr double least_Hz_per_s = 1.0;
  return wave.share > much_of_stretch && std::abs(wave.rate_Hz_per_s) >= least_Hz_per_s;
}

/// Is it the motion's own wave, or a multiple of it? What the model leaves of a motion that sweeps is a sweep too.
bool is_of(const Wave& motion, const Wave& wave) {
  constexpr double off_Hz = 1.0, off_Hz_per_s = 1.0, most_times = 5.0;
  if (motion.share < much_of_stretch) return false;
  const double times = std::clamp(std::round(wave.middle_Hz / motion.middle_Hz), 1.0, most_times);
  return std::abs(wave.middle_Hz - times * motion.middle_Hz) < off_Hz &&
         std::abs(wave.rate_Hz_per_s - times * motion.rate_Hz_per_s) < off_Hz_per_s;
}

/// One after the other, half of each in the next; without a share where the axis has not settled for half of it.
std::vector<Wave> waves_of(const InverseModel& model, const Vector& residual, const Segment& s) {
  const double row_s = model.tracks()[s.run].row_s();
  const auto rows = static_cast<Index>(std::lround(stretch_s / row_s));
  std::vector<Wave> waves;
  for (Index from = 0; from + rows <= s.size; from += rows / 2) {
    Stretch stretch{Vector(rows), Vector(rows), row_s}, motion = stretch;
    const Vector& acceleration = model.tracks()[s.run].acceleration_m_per_s2;
    Index settled = 0;
    for (Index k = 0; k < rows; ++k) {
      const bool in = model.settled(s.start + from + k);
      const double fades =
          std::pow(std::sin(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(rows)), 2);
      stretch.weights[k] = in ? fades : 0.0;
      stretch.values[k] = stretch.weights[k] * residual[s.start + from + k];
      motion.weights[k] = fades;
      motion.values[k] = fades * acceleration[model.sample_of(s, from + k)];
      settled += in ? 1 : 0;
    }
    waves.emplace_back();
    if (2 * settled <= rows || stretch.values.squaredNorm() <= 0.0) continue;
    const Wave wave = strongest(stretch, lowest_Hz);
    const bool may_be_of_motion = (moves(wave) || wave.share > nearly_all_of_stretch) && motion.values.squaredNorm() > 0.0;
    if (!may_be_of_motion || !is_of(strongest(motion, lowest_of_motion_Hz), wave)) waves.back() = wave;
  }
  return waves;
}

/// How far the later one, half a stretch on, is off where the earlier one leads, each as fast for half of the way.
double off_its_way_Hz(const Wave& earlier, const Wave& later) {
  return std::abs(later.middle_Hz - earlier.middle_Hz - 0.25 * stretch_s * (earlier.rate_Hz_per_s + later.rate_Hz_per_s));
}

/// Does the later one, half a stretch on, go on where the earlier one leads, about as fast? Noise of a narrow band is a wave
/// in each stretch too, and one that half shares its rows with the next: four pairs of an axis with nothing hidden turned
/// from -2.5 to +8 Hz a second, from 5 to -4.
bool goes_on(const Wave& earlier, const Wave& later) {
  constexpr double off_Hz = 1.0, off_Hz_per_s = 1.5, off_share = 0.35;
  const double fastest_Hz_per_s = std::max(std::abs(earlier.rate_Hz_per_s), std::abs(later.rate_Hz_per_s));
  if (std::abs(later.rate_Hz_per_s - earlier.rate_Hz_per_s) > std::max(off_Hz_per_s, off_share * fastest_Hz_per_s))
    return false;
  return moves(earlier) && moves(later) && off_its_way_Hz(earlier, later) < off_Hz;
}

/// A wave that is nearly all of its stretches and moves little in each, but steadily: a line that only wanders turns back.
bool creeps(const Wave& earlier, const Wave& later) {
  constexpr double least_Hz = 0.3, off_Hz = 0.4;
  const double by_Hz = later.middle_Hz - earlier.middle_Hz;
  return std::min(earlier.share, later.share) > nearly_all_of_stretch && earlier.rate_Hz_per_s * by_Hz > 0.0 &&
         later.rate_Hz_per_s * by_Hz > 0.0 && std::abs(by_Hz) > least_Hz && off_its_way_Hz(earlier, later) < off_Hz;
}

/// Waves of one after the other that belong together, and how often two did.
struct Chain {
  std::vector<Wave> waves;
  std::size_t pairs = 0, upward = 0;

  void add(const std::vector<Wave>& of_a_run, bool (*belong)(const Wave&, const Wave&)) {
    for (std::size_t i = 0; i < of_a_run.size(); ++i) {
      const bool from_before = i > 0 && belong(of_a_run[i - 1], of_a_run[i]);
      const bool into_next = i + 1 < of_a_run.size() && belong(of_a_run[i], of_a_run[i + 1]);
      if (from_before) ++pairs;
      if (from_before && of_a_run[i].rate_Hz_per_s > 0.0) ++upward;
      if (from_before || into_next) waves.push_back(of_a_run[i]);
    }
  }
  [[nodiscard]] bool one_way() const { return upward == 0 || upward == pairs; }
};

}  // namespace

std::optional<Sweep> sweep_of(const InverseModel& model, const Vector& residual) {
  constexpr std::size_t least_pairs = 4, least_creeping = 6;
  Chain fast, slow;
  for (const auto& s : model.segments()) {
    if (!model.equations()[s.equation].guide) continue;
    const auto waves = waves_of(model, residual, s);
    fast.add(waves, goes_on);
    slow.add(waves, creeps);
  }
  const bool sweeps = fast.pairs >= least_pairs;
  if (!sweeps && !(slow.pairs >= least_creeping && slow.one_way())) return std::nullopt;
  const auto& swept = sweeps ? fast.waves : slow.waves;
  Sweep sweep{swept.front().middle_Hz, swept.front().middle_Hz, 0.0, 0.0};
  for (const auto& wave : swept) {
    const double half_Hz = 0.25 * stretch_s * std::abs(wave.rate_Hz_per_s);
    sweep.low_Hz = std::min(sweep.low_Hz, wave.middle_Hz - half_Hz);
    sweep.high_Hz = std::max(sweep.high_Hz, wave.middle_Hz + half_Hz);
    sweep.rate_Hz_per_s += wave.rate_Hz_per_s / static_cast<double>(swept.size());
    sweep.amplitude_N += wave.amplitude_N / static_cast<double>(swept.size());
  }
  return sweep;
}

}  // namespace feedtwin::tools::diagnosis
