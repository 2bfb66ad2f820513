#pragma once
// When and where the settled rows of the force equations are, and how the axis came there: what structure is looked for
// over.

#include <array>
#include <vector>

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// Of springs that give way with time: a bellows, a counterbalance cylinder that leaks.
inline constexpr std::array relaxation_s{0.1, 0.3, 1.0, 3.0};
/// Of springs that give way after some path, as parts of the runs' travel: seals, and covers that are picked up one by
/// one.
inline constexpr std::array yielding_share{0.01, 0.03, 0.1, 0.25, 0.5};
/// Of what fades, sags, warms or thins with use.
inline constexpr std::array fading_s{0.1, 0.5, 2.0, 8.0};

struct Moment {
  double position_m, velocity_m_per_s, acceleration_m_per_s2, since_reversal_s, since_rest_s, time_s, command_N;
  std::vector<double> past;                              ///< accelerations before
  std::array<double, relaxation_s.size()> strain_m{};    ///< of such springs
  std::array<double, yielding_share.size()> yielding{};  ///< likewise, of the strain at which they give way
  /// Means of the command's square and of the speed over the time before, of the run's largest.
  std::array<double, fading_s.size()> load{}, use{};
  std::size_t run, fold;
  Index sample;
};

inline constexpr std::size_t folds_of_moments = 4;  ///< stretches of each run, in turn
inline constexpr int past_steps = 24;

/// Those of one run, and the rows that they are, the same in each of its force equations.
struct MomentsOfRun {
  std::vector<Moment> moments;
  std::vector<Index> rows;
};
[[nodiscard]] MomentsOfRun moments_of(const InverseModel& model, const Segment& segment);

}  // namespace feedtwin::tools::diagnosis
