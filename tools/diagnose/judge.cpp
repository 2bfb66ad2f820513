#include "tools/diagnose/judge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/diagnose/size_of_axis.h"
#include "tools/linear_systems.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// The fold of each row: seconds of each run, dealt out in turn; all equations of a moment together.
std::vector<std::size_t> folds_of(const InverseModel& model, std::size_t folds) {
  constexpr double stretch_s = 1.0;
  std::vector<std::size_t> fold(static_cast<std::size_t>(model.rows()));
  for (const auto& segment : model.segments()) {
    const double sample_s = model.tracks()[segment.run].sample_s;
    for (Index i = 0; i < segment.size; ++i) {
      const double t = static_cast<double>(model.sample_of(segment, i)) * sample_s;
      fold[static_cast<std::size_t>(segment.start + i)] =
          (static_cast<std::size_t>(t / stretch_s) + 3 * segment.run) % folds;
    }
  }
  return fold;
}

/// A limit or a place enters with a kink: a line through it says nothing about far away.
void freeze_shapes(const Fit& fit, Eigen::MatrixXd& jacobian) {
  Index column = fit.base_count();
  for (const auto& effect : fit.model.effects)
    for (const auto& p : effect.hypothesis->parameters) {
      if (p.kind == Kind::shape) jacobian.col(column).setZero();
      if (fitted(p.kind)) ++column;
    }
}

/// A row that a number only just puts on the other side of a kink, as a gap closes, moves by all of the gap: two to four
/// rows of a run then say more of a number of the whole axis than all others. The narrowest true column, of what acts about
/// rests alone, had 29 rows above a tenth of its largest.
void freeze_flips(const InverseModel& model, const Fit& fit, Eigen::MatrixXd& jacobian) {
  constexpr double share = 0.1;
  constexpr Index few = 8;
  for (const auto& segment : model.segments())
    for (Index column = 0; segment.size > 0 && column < fit.base_count(); ++column) {
      auto own = jacobian.col(column).segment(segment.start, segment.size);
      while (own.squaredNorm() > 0.0) {
        const auto flips = (own.array().abs() > share * own.cwiseAbs().maxCoeff()).eval();
        if (flips.count() > few || flips.select(own, 0.0).squaredNorm() < 0.5 * own.squaredNorm()) break;
        own = flips.select(0.0, own);
      }
    }
}

/// Where the unknowns go, and what every fold costs, under the estimate that leaves it out; linear about the fit.
struct LeftOut {
  std::vector<double> costs;
  Eigen::MatrixXd steps;  ///< a column a fold
};

LeftOut left_out(const InverseModel& model, const Fit& fit, const std::vector<std::size_t>& fold, std::size_t folds,
                 bool shapes_stay) {
  const Index n = fit.jacobian.cols();
  std::vector<std::vector<Index>> rows(folds);
  for (Index k = 0; k < model.rows(); ++k) rows[fold[static_cast<std::size_t>(k)]].push_back(k);
  Eigen::MatrixXd jacobian = fit.jacobian;
  if (shapes_stay) freeze_shapes(fit, jacobian);
  freeze_flips(model, fit, jacobian);
  const Eigen::MatrixXd all = jacobian.transpose() * jacobian;
  LeftOut out{std::vector<double>(folds), Eigen::MatrixXd(n, static_cast<Index>(folds))};
  parallel_for(folds, [&](std::size_t f) {
    const Eigen::MatrixXd own = jacobian(rows[f], Eigen::all);
    const Vector left = fit.white(rows[f]);
    Eigen::MatrixXd rest = all - own.transpose() * own;
    for (Index i = 0; i < n; ++i) rest(i, i) += 1e-9 * all(i, i) + 1e-12;
    const Vector step = solved(rest, -(own.transpose() * left));
    out.costs[f] = (left - own * step).squaredNorm();
    out.steps.col(static_cast<Index>(f)) = step;
  });
  return out;
}

/// Is an effect's size known from one stretch alone, as of a limit that is met once? No other foretells it then.
bool of_one_event(const InverseModel& model, const Fit& fit, const Hypothesis& hypothesis, std::size_t folds) {
  constexpr double nearly_all = 0.999;  // of the squares
  const auto fold = folds_of(model, folds);
  Index column = fit.base_count();
  bool has_a_size = false;
  for (const auto& effect : fit.model.effects)
    for (const auto& p : effect.hypothesis->parameters) {
      if (!fitted(p.kind)) continue;
      if (effect.hypothesis == &hypothesis && p.kind == Kind::amplitude) {
        std::vector<double> squares(folds, 0.0);
        for (Index k = 0; k < model.rows(); ++k)
          squares[fold[static_cast<std::size_t>(k)]] += std::pow(fit.jacobian(k, column), 2);
        has_a_size = true;
        if (std::ranges::max(squares) < nearly_all * std::accumulate(squares.begin(), squares.end(), 0.0)) return false;
      }
      ++column;
    }
  return has_a_size;
}

/// Does it gain what its size asks for?
bool gains_for_its_size(const Fit& with, const Hypothesis& hypothesis, double gain) {
  const auto own = std::ranges::find(with.model.effects, &hypothesis, &Active::hypothesis);
  return hypothesis.least_gain_of == nullptr || own == with.model.effects.end() || gain > hypothesis.least_gain_of(own->q);
}

double prior_part(const Fit& fit) {
  return fit.white.segment(fit.residual.size(), fit.base_count()).squaredNorm();
}

}  // namespace

Bar bar_for(const plant::AxisParameters& nominal) {
  Bar bar;
  bar.force_N *= newton_of(nominal);
  bar.power_W *= newton_of(nominal);
  return bar;
}

std::vector<double> strengths(const InverseModel& model, const Fit& with, const Fit& without, bool about_reversals,
                              const Bar& bar, const std::vector<bool>& only) {
  std::vector<double> by_equation;
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    const auto& equation = model.equations()[e];
    double moved = 0.0, left = 0.0, count = 0.0;
    for (const auto& s : model.segments())
      for (Index k = s.start; s.equation == e && k < s.start + s.size; ++k) {
        if (!model.settled(k) && !about_reversals) continue;
        if (!only.empty() && !only[static_cast<std::size_t>(k)]) continue;
        moved += std::pow(without.residual[k] - with.residual[k], 2);
        left += with.residual[k] * with.residual[k];
        count += 1.0;
      }
    const double floor = equation.slip ? bar.slip_m : equation.power ? bar.power_W : bar.force_N;
    by_equation.push_back(count > 0.0 ? std::sqrt(moved / count) / std::max(floor, std::sqrt(left / count)) : 0.0);
  }
  return by_equation;
}

std::vector<bool> rows_of(const InverseModel& model, const Fit& with, const Fit& without) {
  constexpr double share = 0.1;
  std::vector<double> most(model.equations().size(), 0.0);
  const auto moved = [&](Index k) { return std::abs(without.residual[k] - with.residual[k]); };
  for (const auto& s : model.segments())
    for (Index k = s.start; k < s.start + s.size; ++k) most[s.equation] = std::max(most[s.equation], moved(k));
  std::vector<bool> rows(static_cast<std::size_t>(model.rows()));
  for (const auto& s : model.segments())
    for (Index k = s.start; k < s.start + s.size; ++k)
      rows[static_cast<std::size_t>(k)] = moved(k) > share * most[s.equation];
  return rows;
}

double strength(const InverseModel& model, const Fit& with, const Fit& without, bool about_reversals, const Bar& bar) {
  return std::ranges::max(strengths(model, with, without, about_reversals, bar));
}

Verdict judged(const Fitter& fitter, const Fit& with, const Fit& without, const Hypothesis& hypothesis, const Bar& bar) {
  Verdict v;
  v.gain = without.cost - with.cost;
  v.surprise = prior_part(without) - prior_part(with);
  v.strength = strength(fitter.model(), with, without, hypothesis.about_reversals, bar);
  const double needed =
      std::max(hypothesis.least_gain, bar.gain + bar.per_parameter * static_cast<double>(freedom(hypothesis) - 1));
  const bool doubtful = hypothesis.absorbed && v.surprise < -bar.against_nominal;
  const double least = doubtful ? std::max(bar.strength_against, hypothesis.least_strength) : hypothesis.least_strength;
  const bool strong = v.strength > least && v.gain > needed;
  const bool impossible_otherwise = hypothesis.absorbed && std::min(v.gain, v.surprise) > bar.absorbed_gain &&
                                    (v.strength > bar.absorbed_strength || v.surprise > bar.sure_surprise);
  v.far_off = std::min(v.gain, v.surprise) > hypothesis.far_off_gain;
  v.enough = (strong || impossible_otherwise || v.far_off) && gains_for_its_size(with, hypothesis, v.gain);
  return v;
}

std::vector<double> gains_by_fold(const InverseModel& model, const Fit& with, const Fit& without, std::size_t folds) {
  const auto fold = folds_of(model, folds);
  auto gains = left_out(model, without, fold, folds, true).costs;
  const auto costs = left_out(model, with, fold, folds, true).costs;
  for (std::size_t f = 0; f < folds; ++f) gains[f] -= costs[f];
  return gains;
}

Unseen on_unseen(const InverseModel& model, const Fit& with, const Fit& without, const Hypothesis& hypothesis,
                 const Verdict& verdict, const Bar& bar) {
  const auto gains = gains_by_fold(model, with, without, bar.folds);
  // one fold may hold all that a shape parameter is known from: it must not outvote the others
  const double most_lost = -verdict.gain / static_cast<double>(bar.folds);
  Unseen told;
  for (const double g : gains) told.gain += std::max(g, most_lost);
  told.folds = static_cast<std::size_t>(std::ranges::count_if(gains, [](double g) { return g > 1.0; }));
  const std::size_t may_rest = hypothesis.first_window > 0 ? 1 : 0;  // folds that a process does not act in
  // the folds hold rows alone, not what the numbers' own tolerances have of the gain
  const double gain_in_rows = verdict.gain - std::max(0.0, verdict.surprise);
  told.everywhere = told.folds + may_rest >= bar.folds && told.gain > 0.8 * gain_in_rows;
  const bool has_shape = std::ranges::any_of(hypothesis.parameters, [](const auto& p) { return p.kind == Kind::shape; });
  const bool of_a_moment = told.gain <= 0.0 && !has_shape;  // an amplitude that the others do not foretell where it matters
  const bool nearly_all = 4 * told.folds >= 3 * bar.folds && !of_a_moment;
  // one event is all that there is to learn its numbers from: no other stretch foretells it. A stop struck once left 0.033
  constexpr double left_by_one_event = 0.2;
  // or it strikes harder than anything else: of fourteen false stops none fell by more than 1642 nor had more than 0.63 of
  // strength, of two false saturations 2140 and 0.71; a true one that was met once had 4731 and 1.14
  constexpr double surely_struck_gain = 4000.0, surely_struck_strength = 1.0;
  const bool strikes = verdict.gain > surely_struck_gain && verdict.strength > surely_struck_strength;
  const bool one_event = hypothesis.jumps || of_one_event(model, with, hypothesis, bar.folds);
  const bool is_the_event = one_event && (strikes || with.cost < left_by_one_event * without.cost);
  told.holds = verdict.surprise > 0.5 * verdict.gain || nearly_all || is_the_event ||
               (told.gain > 0.4 * verdict.gain && told.folds >= bar.folds_that_gain);
  return told;
}

double share_beside(const InverseModel& model, const Fit& fit, const std::vector<Fit>& less, std::size_t effect,
                    const Bar& bar) {
  constexpr double shows = 1.0 / 3.0;  // of where it shows most
  const auto& effects = fit.model.effects;
  const auto own = strengths(model, fit, less[effect], effects[effect].hypothesis->about_reversals, bar);
  const auto there = rows_of(model, fit, less[effect]);
  std::vector<double> beside(own.size(), 0.0);
  for (std::size_t other = 0; other < less.size(); ++other) {
    if (other == effect || !worth_naming(effects[other], fit.model.axis)) continue;
    Fit numbers_stay;
    numbers_stay.residual = model.residual(fit.model.axis, without(fit.model, other).effects);
    const auto refitted = strengths(model, fit, less[other], false, bar, there);
    const auto by_itself = strengths(model, fit, numbers_stay, false, bar, there);
    for (std::size_t e = 0; e < own.size(); ++e) beside[e] = std::max(beside[e], std::min(refitted[e], by_itself[e]));
  }
  double share = 0.0;
  for (std::size_t e = 0; e < own.size(); ++e)
    if (own[e] >= shows * std::ranges::max(own)) share = std::max(share, own[e] / std::max(1e-9, beside[e]));
  return share;
}

bool hidden_beside(double share, const Verdict& verdict, const Unseen& unseen, const Bar& bar) {
  const bool leaves_next_to_nothing = unseen.everywhere && verdict.strength > bar.by_itself;
  return !verdict.far_off && !leaves_next_to_nothing && share < bar.beside;
}

Eigen::MatrixXd robust_covariance(const InverseModel& model, const Fit& fit) {
  constexpr std::size_t groups = 16;
  constexpr double widest = 8.0;  // beyond it the line that the jackknife draws is what is wrong
  const Eigen::MatrixXd steps = left_out(model, fit, folds_of(model, groups), groups, false).steps;
  const Vector centre = steps.rowwise().mean();
  const Vector variance =
      (steps.colwise() - centre).rowwise().squaredNorm() * (static_cast<double>(groups - 1) / static_cast<double>(groups));
  const Vector widening =
      variance.cwiseQuotient(fit.covariance.diagonal().cwiseMax(1e-300)).cwiseMax(1.0).cwiseMin(widest * widest).cwiseSqrt();
  return widening.asDiagonal() * fit.covariance * widening.asDiagonal();
}

Eigen::MatrixXd covariance_by_what_is_left(const InverseModel& model, const Fit& fit) {
  return std::max(1.0, fit.cost / static_cast<double>(model.rows())) * robust_covariance(model, fit);
}

}  // namespace feedtwin::tools::diagnosis
