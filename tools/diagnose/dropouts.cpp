#include "tools/diagnose/dropouts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/diagnose/steady_motion.h"
#include "tools/median.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// What stands out of the remainder of a run.
struct Lack {
  double lacking_N = 0.0, commanded_N = 0.0, at_s = 0.0;
  double from_s = 0.0, to_s = 0.0;
  double least_N = 0.0, most_N = 0.0;  ///< of its samples

  /// A step of the encoder in an even motion is an acceleration and the opposite one.
  [[nodiscard]] bool one_way() const {
    constexpr double other_way = 0.5;
    return std::min(-least_N, most_N) < other_way * std::abs(lacking_N);
  }
};

Vector mean_about(const Vector& y, Index samples) {
  Vector mean = y;
  const Index half = samples / 2;
  for (Index k = half; k + half < y.size(); ++k) mean[k] = y.segment(k - half, samples).mean();
  return mean;
}

/// The largest of each group of samples that are farther from the median than noise goes.
void gather_moments(const Track& track, const Vector& lacking_N, const Vector& commanded_N, std::vector<Lack>& moments) {
  constexpr double noise_deviations = 6.0, deviations_of_median = 1.4826;
  constexpr Index apart = 3;
  constexpr std::size_t least_samples = 200;
  const auto steadily = moves_steadily(track);
  std::vector<double> values;
  for (Index k = 0; k < track.size; ++k)
    if (steadily[static_cast<std::size_t>(k)]) values.push_back(lacking_N[k]);
  if (values.size() < least_samples) return;
  const double centre_N = median_of(values);
  for (double& value : values) value = std::abs(value - centre_N);
  const double noise_N = deviations_of_median * median_of(values);
  Index last = -track.size;
  for (Index k = 0; k < track.size; ++k) {
    const double off_N = lacking_N[k] - centre_N;
    if (!steadily[static_cast<std::size_t>(k)] || std::abs(off_N) <= noise_deviations * noise_N) continue;
    const double now_s = static_cast<double>(k) * track.sample_s;
    if (k - last > apart) moments.push_back({.from_s = now_s});
    last = k;
    Lack& lack = moments.back();
    lack.to_s = now_s;
    lack.least_N = std::min(lack.least_N, off_N), lack.most_N = std::max(lack.most_N, off_N);
    if (std::abs(off_N) > std::abs(lack.lacking_N))
      lack.lacking_N = off_N, lack.commanded_N = commanded_N[k], lack.at_s = now_s;
  }
}

/// The share that they lack in common. A damaged spot opposes every pass alike, but for longer.
std::optional<Dropouts> in_common(const std::vector<Lack>& moments) {
  constexpr std::size_t least_moments = 8;
  constexpr double longest_s = 0.015, alike = 0.25, least_alike = 0.8, least = 0.05, most = 1.2, least_command_N = 1e-9;
  if (moments.size() < least_moments) return std::nullopt;
  std::vector<double> shares;
  for (const auto& m : moments)
    shares.push_back(m.lacking_N / std::copysign(std::max(least_command_N, std::abs(m.commanded_N)), m.commanded_N));
  const double share = median_of(shares);
  std::size_t same = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool short_enough = moments[i].to_s - moments[i].from_s < longest_s;
    if (short_enough && moments[i].one_way() && std::abs(shares[i] - share) < alike * std::abs(share)) ++same;
  }
  if (share < least || share > most) return std::nullopt;
  if (static_cast<double>(same) < least_alike * static_cast<double>(shares.size())) return std::nullopt;
  const auto [first, last] = std::ranges::minmax(moments, {}, &Lack::at_s);
  return Dropouts{share, moments.size(), first.at_s, last.at_s};
}

}  // namespace

std::optional<Dropouts> dropouts_of(const InverseModel& model, const Candidate& at) {
  const auto lacking_N = forces_left_N(model, at);
  for (const Index samples : {1, 3}) {
    std::vector<Lack> moments;
    for (std::size_t run = 0; run < lacking_N.size(); ++run) {
      const Track& track = model.tracks()[run];
      gather_moments(track, mean_about(lacking_N[run], samples), mean_about(track.command_N, samples), moments);
    }
    if (auto found = in_common(moments)) return found;
  }
  return std::nullopt;
}

bool torque_fails_for_moments(const InverseModel& model, const Candidate& recalibrated, const Candidate& named) {
  return dropouts_of(model, recalibrated) && dropouts_of(model, named);
}

}  // namespace feedtwin::tools::diagnosis
