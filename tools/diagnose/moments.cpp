#include "tools/diagnose/moments.h"

#include <algorithm>
#include <cmath>

#include "tools/diagnose/taken_up.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double past_step_s = 0.012, stretch_s = 0.73;  // no motion repeats in step with it

/// s' = v - s / T, by relaxation time: of a Maxwell element that has come to rest before the run.
std::vector<std::array<double, relaxation_s.size()>> strains_m(const Track& track) {
  std::vector<std::array<double, relaxation_s.size()>> all(static_cast<std::size_t>(track.size));
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t i = 0; i < relaxation_s.size(); ++i) {
      const auto at = static_cast<Index>(k);
      all[k][i] =
          (all[k - 1][i] + track.position_m[at] - track.position_m[at - 1]) / (1.0 + track.sample_s / relaxation_s[i]);
    }
  return all;
}

/// Strain that follows the path up to where the spring gives way, as a part of that; begins without any.
std::vector<std::array<double, yielding_share.size()>> yielding(const Track& track, double travel_m) {
  std::vector<std::array<double, yielding_share.size()>> all(static_cast<std::size_t>(track.size));
  constexpr double beyond_presliding_m = 2e-4;
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t i = 0; i < yielding_share.size(); ++i) {
      const auto at = static_cast<Index>(k);
      const double path =
          (track.position_m[at] - track.position_m[at - 1]) / std::max(beyond_presliding_m, yielding_share[i] * travel_m);
      all[k][i] = std::clamp(all[k - 1][i] + path, -1.0, 1.0);
    }
  return all;
}

/// Time since the axis last left a rest of some length, by sample; long where it has not rested. A rest is where the
/// encoder's grid alone moves, which the track's own dwells, for friction that is followed, do not ask.
std::vector<double> since_rest_s(const Track& track) {
  constexpr double a_rest_s = 0.1, long_ago_s = 1e3;
  std::vector<double> all(static_cast<std::size_t>(track.size));
  double since = long_ago_s, dwelt = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const bool rests = std::abs(track.steady_m_per_s[k]) < standstill_m_per_s;
    dwelt = rests ? dwelt + track.sample_s : 0.0;
    since = dwelt > a_rest_s ? 0.0 : since + track.sample_s;
    all[static_cast<std::size_t>(k)] = since;
  }
  return all;
}

/// m' = (x - m) / T of a quantity, by time constant.
std::vector<std::array<double, fading_s.size()>> means_before(const Vector& quantity, double sample_s) {
  std::vector<std::array<double, fading_s.size()>> all(static_cast<std::size_t>(quantity.size()));
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t i = 0; i < fading_s.size(); ++i)
      all[k][i] = all[k - 1][i] + (quantity[static_cast<Index>(k)] - all[k - 1][i]) * sample_s / (fading_s[i] + sample_s);
  return all;
}

Vector of_largest(const Vector& quantity) {
  return quantity / (quantity.maxCoeff() + 1e-12);
}

}  // namespace

MomentsOfRun moments_of(const InverseModel& model, const Segment& segment) {
  MomentsOfRun found;
  const Track& track = model.tracks()[segment.run];
  const Index step = std::max<Index>(1, std::lround(past_step_s / track.sample_s));
  const auto acceleration = [&track](Index k) { return slow_acceleration_m_per_s2(track, k); };
  const auto strains = strains_m(track);
  const auto yields = yielding(track, travel_of(model.tracks(), &Track::position_m).length_m());
  const auto since_rest = since_rest_s(track);
  const auto load = means_before(of_largest(track.command_N.cwiseAbs2()), track.sample_s);
  const auto use = means_before(of_largest(track.steady_m_per_s.cwiseAbs()), track.sample_s);
  for (Index i = 0; i < segment.size; ++i) {
    if (!model.settled(segment.start + i)) continue;
    const Index k = model.sample_of(segment, i);
    const auto at = static_cast<std::size_t>(k);
    const double t = static_cast<double>(k) * track.sample_s;
    Moment m{track.position_m[k],
             track.centred_m_per_s[k],
             acceleration(k),
             track.since_reversal_s[k],
             since_rest[at],
             t,
             track.command_N[k],
             {},
             strains[at],
             yields[at],
             load[at],
             use[at],
             segment.run,
             (static_cast<std::size_t>(t / stretch_s) + segment.run) % folds_of_moments,
             k};
    for (int j = 0; j < past_steps; ++j) m.past.push_back(acceleration(std::max<Index>(0, k - j * step)));
    found.moments.push_back(std::move(m));
    found.rows.push_back(i);
  }
  return found;
}

}  // namespace feedtwin::tools::diagnosis
