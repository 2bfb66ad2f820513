#include "tools/diagnose/lost_counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "tools/median.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t beside = 3;  // samples before and after that say what the motion was

/// Beside what a step is short of counts: the table's where a scale shows that, or the encoder's own alone, since a scale
/// may be noisier than the motion is rough.
enum class Beside { table, itself };

/// A sample within which the reading jumps.
struct Jump {
  std::size_t run, row;  ///< first with the new reading
  double counts, rev;    ///< lost; where the shaft was
  double stay;           ///< counts that a scale still misses some rows later; 0 without one
};

/// What the median says, where the cubic says about as much: in a bend it has 0.6 of it at most.
double agreed(double by_median, double by_cubic) {
  constexpr double about = 0.65;
  return by_cubic * by_median >= about * by_median * by_median ? by_median : 0.0;
}

/// Counts that each sample's step is short of what the steps beside it are, by their median and along a cubic through them:
/// where the axis speeds up hard the middle of a bend is no jump.
std::vector<double> short_of(const Recording& run, double count_m, Beside what) {
  const auto shown = run.at(channel::position_m);
  const auto table = what == Beside::table ? run.at(channel::scale_position_m) : std::span<const double>{};
  std::vector<double> step(shown.size(), 0.0), lost(shown.size(), 0.0);
  for (std::size_t k = 1; k < shown.size(); ++k)
    step[k] = (shown[k] - shown[k - 1] - (table.empty() ? 0.0 : table[k] - table[k - 1])) / count_m;
  for (std::size_t k = beside + 1; k + beside < shown.size(); ++k) {
    std::array<double, 2 * beside> around{};
    std::copy_n(step.begin() + static_cast<std::ptrdiff_t>(k - beside), beside, around.begin());
    std::copy_n(step.begin() + static_cast<std::ptrdiff_t>(k + 1), beside, around.begin() + beside);
    std::ranges::sort(around);
    const double cubic = (4.0 * (step[k - 1] + step[k + 1]) - step[k - 2] - step[k + 2]) / 6.0;
    lost[k] = agreed(0.5 * (around[beside - 1] + around[beside]) - step[k], cubic - step[k]);
  }
  return lost;
}

/// By how many counts the reading falls back behind the scale from the rows before to those after; as it jumps, near an end.
double missed_later(const Recording& run, std::size_t row, double counts, double count_m) {
  constexpr std::size_t rows = 20;
  const auto shown = run.at(channel::position_m), table = run.at(channel::scale_position_m);
  if (table.empty()) return 0.0;
  if (row < rows + 1 || row + rows >= shown.size()) return counts;
  double change = 0.0;
  for (std::size_t i = 1; i <= rows; ++i) change += (table[row + i] - shown[row + i]) - (table[row - i] - shown[row - i]);
  return change / (static_cast<double>(rows) * count_m);
}

std::vector<Jump> jumps_of(const std::vector<Recording>& runs, std::size_t number, const plant::AxisParameters& axis,
                           Beside what) {
  constexpr double least_counts = 5.0, least_sigmas = 10.0;
  const double count_m = axis.axis.lead_m / axis.axis.encoder_counts_per_rev;
  const Recording& run = runs[number];
  const auto lost = short_of(run, count_m, what);
  std::vector<double> size(lost.size());
  std::ranges::transform(lost, size.begin(), [](double one) { return std::abs(one); });
  const double limit = std::max(least_counts, least_sigmas * 1.4826 * median_of(size));
  std::vector<Jump> found;
  for (std::size_t k = 0; k < lost.size(); ++k) {
    if (std::abs(lost[k]) <= limit) continue;
    const Jump jump{number, k, lost[k], run.at(channel::position_m)[k] / axis.axis.lead_m,
                    missed_later(run, k, lost[k], count_m)};
    // the steps beside a jump are short of it
    if (found.empty() || found.back().row + beside < k)
      found.push_back(jump);
    else if (std::abs(found.back().counts) < std::abs(lost[k]))
      found.back() = jump;
  }
  return found;
}

/// Those of at least half the size; smaller ones are what the motion does where it jerks.
std::vector<Jump> as_large(const std::vector<Jump>& jumps, double counts) {
  std::vector<Jump> kept;
  std::ranges::copy_if(jumps, std::back_inserter(kept),
                       [&](const Jump& one) { return std::abs(one.counts) >= 0.5 * std::abs(counts); });
  return kept;
}

/// Without its sign; of what a scale tells of it, where the encoder's own steps only said when.
double size_of(const std::vector<Jump>& jumps, Beside what) {
  if (jumps.empty()) return 0.0;
  const auto largest = std::ranges::max_element(jumps, {}, [](const Jump& one) { return std::abs(one.counts); });
  std::vector<double> sizes;
  for (const Jump& one : as_large(jumps, largest->counts))
    sizes.push_back(std::abs(what == Beside::table ? one.counts : one.stay));
  return std::round(median_of(std::move(sizes)));
}

bool alike(const Jump& one, double counts) {
  constexpr double share = 0.2;
  return std::abs(std::abs(one.counts) - counts) <= share * counts;
}

/// A shaft that is at one place twice has passed it back in between: what a mark's pass had lost would have been given back.
bool not_given_back(const std::vector<Jump>& jumps) {
  constexpr double same_place_rev = 0.1;
  for (std::size_t i = 1; i < jumps.size(); ++i) {
    const Jump &one = jumps[i - 1], &next = jumps[i];
    if (one.run == next.run && one.counts * next.counts > 0.0 && std::abs(one.rev - next.rev) < same_place_rev) return true;
  }
  return false;
}

/// Of one size, and not what passes of one mark of the shaft take and give back.
bool of_its_own(const std::vector<Jump>& jumps, double counts) {
  // a screw that gives where friction lets go made four of 7 counts
  constexpr std::size_t least_moments = 4, least_of_few_counts = 8;
  constexpr double few_counts = 10.0;
  constexpr double most_others = 0.1, at_a_mark = 0.9;
  if (jumps.size() < (counts < few_counts ? least_of_few_counts : least_moments)) return false;
  double others = 0.0;
  std::complex<double> mark = 0.0;
  for (const Jump& one : jumps) {
    if (!alike(one, counts)) others += 1.0;
    mark += std::polar(1.0, 2.0 * std::numbers::pi * one.rev);
  }
  const auto all = static_cast<double>(jumps.size());
  return others <= most_others * all && (std::abs(mark) < at_a_mark * all || not_given_back(jumps));
}

/// Lost one time and gained another is what an encoder that jitters looks like too; lost counts stay lost.
bool all_stay(const std::vector<Jump>& jumps, double counts) {
  constexpr double share = 0.7;  // more where two follow one another
  return std::ranges::all_of(jumps,
                             [&](const Jump& one) { return std::copysign(1.0, one.counts) * one.stay >= share * counts; });
}

void give_back(std::vector<Recording>& runs, const plant::AxisParameters& axis, double counts, Beside what) {
  const double lost_m = counts * axis.axis.lead_m / axis.axis.encoder_counts_per_rev;
  for (std::size_t number = 0; number < runs.size(); ++number) {
    const auto jumps = jumps_of(runs, number, axis, what);
    for (const auto name : {channel::position_m, channel::reference_m})
      if (const auto found = runs[number].channels.find(name); found != runs[number].channels.end())
        for (const Jump& jump : jumps)
          for (std::size_t k = jump.row; alike(jump, counts) && k < found->second.size(); ++k)
            found->second[k] += std::copysign(lost_m, jump.counts);
  }
}

std::optional<LostCounts> give_back(Case& data, Beside what) {
  std::vector<Jump> all;
  double time_s = 0.0;
  for (std::size_t number = 0; number < data.fit.size(); ++number) {
    std::ranges::copy(jumps_of(data.fit, number, data.axis, what), std::back_inserter(all));
    time_s += data.fit[number].duration_s();
  }
  const double counts = size_of(all, what);
  const auto lost = as_large(all, counts);
  if (!of_its_own(lost, counts)) return std::nullopt;
  const auto gained = std::ranges::count_if(lost, [](const Jump& one) { return one.counts < 0.0; });
  const bool both = gained > 0 && gained < static_cast<std::ptrdiff_t>(lost.size());
  if (both && !all_stay(lost, counts)) return std::nullopt;
  for (auto* runs : {&data.fit, &data.holdout}) give_back(*runs, data.axis, counts, what);
  double squares = 0.0;
  for (const Jump& one : lost) squares += std::pow(std::abs(one.counts) - counts, 2);
  const double deviation = std::sqrt(squares) / static_cast<double>(lost.size());
  return LostCounts{counts, deviation, static_cast<double>(lost.size()) / time_s, static_cast<int>(lost.size()),
                    static_cast<int>(gained)};
}

}  // namespace

std::optional<LostCounts> give_back_lost_counts(Case& data) {
  const auto found = give_back(data, Beside::table);
  const bool scale = !data.fit.front().at(channel::scale_position_m).empty();
  return found || !scale ? found : give_back(data, Beside::itself);
}

}  // namespace feedtwin::tools::diagnosis
