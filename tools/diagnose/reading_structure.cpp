#include "tools/diagnose/reading_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnose/beat.h"
#include "tools/diagnose/folded.h"
#include "tools/diagnose/size_of_axis.h"
#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index least_readings = 200;

/// What moves with the misfit and what the catalogue has names for, out.
Vector without_numbers(const Vector& y, const Eigen::MatrixXd& numbers) {
  return y - numbers * least_squares(numbers, y);
}

/// The same of what it could follow, a column a row of it: or it would have to make up for what the numbers took off.
Eigen::MatrixXd without_numbers_in_each(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& numbers) {
  const Eigen::MatrixXd known = inverse_of(numbers.transpose() * numbers) * (numbers.transpose() * columns.transpose());
  return columns - (numbers * known).transpose();
}

struct Predicted {
  Vector unseen;
  Follows follows;
  double every = 0.0;
};

/// A clock that what comes over and over is looked for by: time, whose phase is each run's own, or what is read as if its
/// range took so long, which makes 6 to 100 steps.
struct Clock {
  Follows follows;
  std::vector<BeatMoment> moments;
  double per_s;  ///< in the misfit's unit, or seconds
};

std::vector<Clock> clocks_of(const ReadingRows& rows) {
  constexpr double range_s = 25.0;
  const auto [least, most] = std::ranges::minmax(rows.reading);
  std::vector<Clock> clocks{{Follows::time, {}, 1.0}, {Follows::reading_by_step, {}, (most - least + 1e-300) / range_s}};
  for (std::size_t k = 0; k < rows.fold.size(); ++k) {
    clocks[0].moments.push_back({rows.time_s[k], true, rows.run[k], rows.fold[k]});
    clocks[1].moments.push_back({(rows.reading[k] - least) / clocks[1].per_s, true, 0, rows.fold[k]});
  }
  return clocks;
}

Predicted best_of(const ReadingRows& rows, const Vector& y) {
  const AdditiveModel additive(without_numbers_in_each(rows.columns, rows.numbers), rows.fold, rows.ways, rows.rows_of_zero);
  const std::size_t alone = additive.ways() - (rows.follows.back() == Follows::several ? 1 : 0);
  auto [predicted, way] = additive.unseen(y, alone);
  Predicted best{std::move(predicted), rows.follows[way]};
  const auto left = [&](const Predicted& by) { return (y - by.unseen).squaredNorm(); };
  const auto or_better = [&](Predicted other, double less = 1.0) {
    if (left(other) < less * left(best)) best = std::move(other);
  };
  constexpr double clearly = 0.9;     // a wave is a harmonic of slower pulses too
  constexpr double by_several = 0.1;  // of all, more than by one of them
  if (alone < additive.ways()) {
    Predicted several{additive.unseen(y, additive.ways()).predicted, Follows::several};
    if (left(several) + by_several * y.squaredNorm() < left(best)) best = std::move(several);
  }
  const std::size_t folds = *std::ranges::max_element(rows.fold) + 1;
  for (const auto& clock : clocks_of(rows)) {
    const Beat beat(clock.moments, folds);
    or_better({beat.unseen(y), clock.follows, clock.per_s / beat.wave_Hz(y)});
    or_better({beat.pulses_unseen(y), clock.follows, clock.per_s / beat.pulses_Hz(y)}, clearly);
    const Folded folded(clock.moments, folds);
    or_better({folded.unseen(y), clock.follows, clock.per_s * folded.period_s(y)}, clearly);
  }
  return best;
}

double rms_of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size())).norm() /
         std::sqrt(static_cast<double>(values.size()));
}

ReadingStructure structure_of_reading(const ReadingRows& rows, const Vector& residual, double newton) {
  ReadingStructure found;
  found.channel = rows.channel;
  if (rows.of_force) found.per_newton = rows.per_unit * newton;
  if (rows.channel != channel::scale_position_m) found.read = rows.per_unit * rms_of(rows.reading);
  const Vector shown_behind = residual(rows.after), after = without_numbers(shown_behind, rows.numbers);
  Vector before = Vector::Zero(after.size()), y = after, shown = shown_behind;
  if (!rows.before.empty()) {
    const Vector shown_ahead = -residual(rows.before);
    before = without_numbers(shown_ahead, rows.numbers);
    const double share = before.squaredNorm() / (before.squaredNorm() + after.squaredNorm() + 1e-300);
    y = share * after + (1.0 - share) * before;
    shown = share * shown_behind + (1.0 - share) * shown_ahead;
  }
  const Predicted best = best_of(rows, y);
  const bool clock = best.follows == Follows::time;
  found.follows = best.follows;
  found.every = clock ? best.every : rows.per_unit * best.every;
  found.share = y.squaredNorm() > 0.0 ? 1.0 - (y - best.unseen).squaredNorm() / y.squaredNorm() : 0.0;
  found.remainder = rows.per_unit * std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
  if (!rows.before.empty())
    found.of_reading = std::min(after.dot(best.unseen), before.dot(best.unseen)) / (best.unseen.squaredNorm() + 1e-300);
  if (found.stands_out())
    found.table =
        learn_reading(rows, shown, best.follows == Follows::reading_by_step ? best.every : 0.0, clock ? best.every : 0.0);
  return found;
}

}  // namespace

double ReadingStructure::structured() const {
  return remainder * std::sqrt(std::max(0.0, share));
}

// Of 41 made cases with nothing hidden none had more than 0.07 of a power predicted, nor 0.03 of a command, a scale or a
// torque sensor; of a force sensor up to 0.5, by what the axis does, but less than 0.54 of that in both equations. Steps of
// a drive's converter had 0.16; those that a count makes in the command of an axis without any noise 0.16 of 0.26 N. Two
// contacts that no Stribeck curve describes gave a force sensor 0.57 over speed, half of a hundredth of what it read.
// Of 300 more with nothing hidden one power kept time by 0.13, a meter's few readings, and of another 300 one command by
// 0.127, which has in it what disturbs the axis slowly; a pump and a fan by 0.45 and more; a brake's coil that is let go at
// rest followed how long the axis had stood by 0.49.
bool ReadingStructure::stands_out() const {
  constexpr double least = 0.1, least_N = 0.2, least_of_reading = 0.7, least_of_read = 0.02, least_by_clock = 0.2;
  const bool by_rest = follows == Follows::rest;
  const bool by_itself = follows == Follows::reading_by_step || follows == Follows::time || by_rest;
  const bool power = channel == channel::power_W, command = channel == channel::torque_cmd_Nm;
  const bool by_chance = ((power || command) && follows == Follows::time) || (power && by_rest);
  return share > (by_chance ? least_by_clock : least) && of_reading > least_of_reading &&
         (per_newton == 0.0 || structured() > least_N * per_newton) && (by_itself || structured() > least_of_read * read);
}

std::vector<ReadingStructure> structure_of_readings(const InverseModel& model, const Candidate& at) {
  const Vector residual = model.residual(at.axis, at.effects);
  std::vector<ReadingStructure> all;
  auto channels = rows_of_sensors(model, at.axis.axis.lead_m, residual);
  for (auto& power : rows_of_power(model, residual))
    if (!model.tracks().front().meter.of_command) channels.push_back(std::move(power));
  for (const auto& rows : channels)
    if (rows.columns.cols() >= least_readings)
      all.push_back(structure_of_reading(rows, residual, newton_of(model.nominal())));
  return all;
}

std::optional<ReadingStructure> what_stands_out(const InverseModel& model, const Candidate& at,
                                                const std::function<void(std::string_view)>& progress) {
  std::optional<ReadingStructure> first;
  for (const auto& reading : structure_of_readings(model, at)) {
    progress(fmt::format(
        "reading {}: {:.2g} of {:.2g} left over, share {:.3f}, follows {}; in the equations on both sides {:.2f}",
        reading.channel, reading.structured(), reading.remainder, reading.share, what_it_follows(reading),
        reading.of_reading));
    if (reading.stands_out() && !first) first = reading;
  }
  return first;
}

std::string what_it_follows(const ReadingStructure& reading) {
  switch (reading.follows) {
    case Follows::reading:
      return "what is read, along a curve";
    case Follows::reading_by_step:
      return fmt::format("steps of {:.3g} in what is read", reading.every);
    case Follows::reading_before:
      return "what was read before";
    case Follows::place:
      return "position";
    case Follows::speed:
      return "speed";
    case Follows::motion:
      return "acceleration and force";
    case Follows::use:
      return "how hard and how fast the axis has run lately";
    case Follows::drive:
      return "what is commanded and the power that it makes";
    case Follows::rest:
      return "how long the axis has stood";
    case Follows::several:
      return "reading, position, speed and acceleration together";
    default:
      return fmt::format("time, over and over every {:.3g} s", reading.every);
  }
}

}  // namespace feedtwin::tools::diagnosis
