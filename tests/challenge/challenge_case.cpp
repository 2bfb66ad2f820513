#include "tests/challenge/challenge_case.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/challenge/chance.h"
#include "tests/challenge/strength.h"

namespace feedtwin::challenge {
namespace {

using Random = std::mt19937_64;

constexpr double least_residual_N = 0.5;  ///< below it nobody's model of a real axis gets

/// Every number times 1 + spread * normal, kept within three spreads.
Axis spread_numbers(Axis axis, double spread, Random& random) {
  std::normal_distribution<double> normal;
  const auto move = [&](double& value) { value *= 1.0 + spread * std::clamp(normal(random), -2.5, 2.5); };
  for (double* value :
       {&axis.motor_inertia_kgm2, &axis.screw_inertia_kgm2, &axis.table_kg, &axis.motor_damping_pos_Nms,
        &axis.motor_damping_neg_Nms, &axis.motor_coulomb_pos_N, &axis.motor_coulomb_neg_N, &axis.ke2_pos, &axis.ke2_neg})
    move(*value);
  for (Friction* f : {&axis.screw, &axis.guide}) {
    for (Side* s : {&f->pos, &f->neg}) {
      move(s->coulomb_N);
      move(s->static_N);
      move(s->stribeck_m_per_s);
      move(s->viscous_Ns_per_m);
      s->static_N = std::max(s->static_N, 1.02 * s->coulomb_N);
    }
  }
  return axis;
}

std::vector<const Hidden*> draw_hidden(const Wish& wish, const std::string& kind, Random& random) {
  std::vector<const Hidden*> hidden;
  const std::size_t wanted = kind == "single" || kind == "outside" ? 1 : kind == "pair" ? 2 : kind == "triple" ? 3 : 0;
  if (!wish.effect.empty() && wanted > 0) {
    hidden.push_back(find_hidden(wish.effect));
    if (hidden.back() == nullptr) throw std::runtime_error("no such effect: " + wish.effect);
  }
  const auto& from = kind == "outside" ? outside() : catalogue();
  while (hidden.size() < wanted) {
    const Hidden* next = &from[std::uniform_int_distribution<std::size_t>(0, from.size() - 1)(random)];
    const bool clash = std::ranges::any_of(hidden, [next](const Hidden* other) {
      return other == next || std::ranges::count(other->alike, next->id) > 0 ||
             std::ranges::count(next->alike, other->id) > 0;
    });
    // several at once: only what stands on its own
    if (!clash && (wanted == 1 || (!next->number_only && next->id != "wrong_lead"))) hidden.push_back(next);
  }
  return hidden;
}

unsigned draw_channels(const std::vector<const Hidden*>& hidden, Random& random) {
  constexpr std::array choices = {unsigned{all_channels}, unsigned{all_channels}, torque_sensor | force_sensor | power,
                                  scale | power,          unsigned{power},        unsigned{none}};
  unsigned channels = choices[std::uniform_int_distribution<std::size_t>(0, choices.size() - 1)(random)];
  for (const Hidden* h : hidden) channels |= h->needs;
  return channels;
}

Noise draw_noise(const std::string& kind, Random& random) {
  Noise noise;
  noise.torque_sensor_Nm *= uniform(random, 0.6, 2.0);
  noise.force_sensor_N *= uniform(random, 0.6, 2.0);
  noise.encoder_counts = chance(random, 0.4) ? uniform(random, 0.1, 0.5) : 0.0;
  if (kind == "coloured" || chance(random, 0.4)) {
    noise.colour = uniform(random, 0.7, 0.97);
    noise.burst_share = chance(random, 0.5) ? 0.08 : 0.0;
    noise.disturbance_N = uniform(random, 0.3, kind == "coloured" ? 4.0 : 1.5);
    noise.disturbance_s = std::exp(uniform(random, std::log(2e-3), std::log(0.1)));
  }
  return noise;
}

Gains draw_gains(Random& random) {
  return {.position_per_s = uniform(random, 30.0, 75.0),
          .velocity_Ns_per_m = uniform(random, 5000.0, 11000.0),
          .integral_N_per_m = uniform(random, 1e5, 4e5),
          .velocity_feedforward = chance(random, 0.8) ? 1.0 : uniform(random, 0.5, 0.9),
          .acceleration_feedforward_kg = 0.0};
}

/// Where floor and process are as each run begins: a third of the cases start with them, a third whenever it comes, but all
/// runs alike, a third each run as it comes.
std::vector<double> draw_phases(std::size_t runs, Random random) {
  const double kind = uniform(random, 0.0, 3.0);
  std::vector<double> phases_rad(runs, kind < 1.0 ? 0.0 : uniform(random, -3.14, 3.14));
  for (double& phase_rad : phases_rad)
    if (kind >= 2.0) phase_rad = uniform(random, -3.14, 3.14);
  return phases_rad;
}

Effects in_run(const Case& c, Effects effects, std::size_t run) {
  effects.line_phase_rad = c.line_phases_rad[run];
  return effects;
}

std::vector<Run> runs_of(const Case& c, const std::vector<MotionPlan>& plans, const Effects& effects, const Axis& truth,
                         const Gains& gains, std::uint64_t seed) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < plans.size(); ++i)
    runs.push_back(record(truth, in_run(c, effects, i), c.noise, gains, plans[i], seed * 101 + i));
  return runs;
}

/// Moves the nominal sliding and viscous friction and mass as a fit to these runs would.
void refit_nominal(Case& c, const std::vector<double>& with, const std::vector<double>& without) {
  const double k = 6.283185307179586 / c.nominal.lead_m;
  const auto change = [&](std::size_t i) { return with[i] - without[i]; };
  const auto moved = [](double value, double by) { return std::max(0.3 * value, value + by); };
  c.nominal.motor_inertia_kgm2 = moved(c.nominal.motor_inertia_kgm2, change(0) / (k * k));
  c.nominal.screw.pos.viscous_Ns_per_m = moved(c.nominal.screw.pos.viscous_Ns_per_m, change(1));
  c.nominal.screw.neg.viscous_Ns_per_m = moved(c.nominal.screw.neg.viscous_Ns_per_m, change(2));
  for (auto [side, place] : {std::pair{&c.nominal.screw.pos, 3}, {&c.nominal.screw.neg, 4}}) {
    const double by = change(static_cast<std::size_t>(place));
    side->coulomb_N = moved(side->coulomb_N, by);
    side->static_N = std::max(1.02 * side->coulomb_N, moved(side->static_N, by));
  }
}

}  // namespace

Case make_case(const Wish& wish) {
  Random random(wish.seed * 0x9E3779B97F4A7C15ULL + 77);
  Case c;
  c.kind = wish.kind.empty() ? "single" : wish.kind;
  c.truth = spread_numbers(Axis{}, 0.08, random);
  c.truth.counts_per_rev = chance(random, 0.8) ? 65536.0 : 100000.0;
  c.truth.maxwell_slip = chance(random, 0.35);
  if (chance(random, 0.3)) c.truth.coupling_N_per_m = uniform(random, 1.5e8, 4e8);
  c.truth.coupling_damping_Ns_per_m = 2000.0;
  c.hidden = draw_hidden(wish, c.kind, random);
  c.channels = draw_channels(c.hidden, random);
  c.noise = draw_noise(c.kind, random);
  const Gains gains = draw_gains(random);
  const auto has = [&c](const char* id) {
    return std::ranges::any_of(c.hidden, [id](const Hidden* h) { return h->id == id; });
  };
  if (has("screw_compliance")) c.truth.coupling_N_per_m = uniform(random, 2.0e7, 4.5e7);
  if (has("backlash")) c.truth.coupling_N_per_m = uniform(random, 4e7, 8e7);

  const bool dwells = chance(random, 0.25) || std::ranges::any_of(c.hidden, [](const Hidden* h) { return h->wants_dwell; });
  const std::vector<std::string> kinds = dwells ? std::vector<std::string>{"stair", "dwell", "multi", "dwell"}
                                                : std::vector<std::string>{"stair", "sine", "multi", "tri"};
  std::vector<MotionPlan> plans;
  for (const auto& kind : kinds) plans.push_back(draw_motion(kind, random));
  c.line_phases_rad = draw_phases(plans.size(), Random(wish.seed * 0x9E3779B97F4A7C15ULL + 78));

  const std::uint64_t shape = random();
  const auto bare = runs_of(c, plans, {}, c.truth, gains, wish.seed);
  const Leftover without = leftover(bare, c.truth.lead_m);
  c.residual_N = std::max(least_residual_N, without.rms_N);
  Reach reach{0.0, 0.0};
  for (const auto& run : bare) {
    for (const Sample& s : run) {
      reach.position_m = std::max(reach.position_m, s.position_m);
      reach.torque_Nm = std::max(reach.torque_Nm, std::abs(s.torque_cmd_Nm));
    }
  }

  std::vector<double> strengths;
  const double target = wish.strength > 0.0 ? wish.strength : std::exp(uniform(random, std::log(0.4), std::log(12.0)));
  for (const Hidden* h : c.hidden) strengths.push_back(std::exp(uniform(random, std::log(h->low), std::log(h->high))));
  const auto set_all = [&] {
    c.effects = {};
    for (std::size_t i = 0; i < c.hidden.size(); ++i) c.hidden[i]->set(c.effects, strengths[i], Random(shape + i), reach);
  };
  // each effect that shows in the torque alone: to the wished strength, by secant in the logarithm; on an axis with the
  // quicker friction, which leaves the same
  Axis quick = c.truth;
  quick.maxwell_slip = false;
  quick.coupling_N_per_m = 0.0;
  const Leftover quick_without =
      c.truth.maxwell_slip ? leftover(runs_of(c, plans, {}, quick, gains, wish.seed), c.truth.lead_m) : without;
  for (std::size_t i = 0; i < c.hidden.size(); ++i) {
    const Hidden& h = *c.hidden[i];
    if (!h.seen_in_torque) continue;
    for (int round = 0; round < 4; ++round) {
      Effects alone;
      h.set(alone, strengths[i], Random(shape + i), reach);
      const double rms_N = leftover(runs_of(c, plans, alone, quick, gains, wish.seed), c.truth.lead_m).rms_N;
      const double now_N = std::sqrt(std::max(1e-4, rms_N * rms_N - quick_without.rms_N * quick_without.rms_N));
      const double by = target * c.residual_N / now_N;
      if (std::abs(std::log(by)) < 0.15) break;
      strengths[i] = std::clamp(strengths[i] * std::clamp(by, 0.05, 20.0), 0.2 * h.low, h.high);
    }
  }
  set_all();

  auto runs = c.hidden.empty() ? bare : runs_of(c, plans, c.effects, c.truth, gains, wish.seed);
  const Leftover with = leftover(runs, c.truth.lead_m);
  c.effect_N = std::sqrt(std::max(0.0, with.rms_N * with.rms_N - without.rms_N * without.rms_N));
  c.wrong_by = c.kind == "none" ? 1e-4 : uniform(random, 0.03, 0.10);
  c.nominal = spread_numbers(c.truth, c.wrong_by, random);
  c.masked = !c.hidden.empty() && chance(random, 0.4);
  if (c.masked) refit_nominal(c, with.numbers, without.numbers);
  Axis plain = c.truth;
  if (has("screw_compliance")) plain.coupling_N_per_m = 0.0;
  const std::uint64_t noise_of_last = wish.seed * 101 + plans.size() - 1;
  const Run without_effects =
      has("screw_compliance") ? record(plain, {}, c.noise, gains, plans.back(), noise_of_last) : bare.back();
  const Run again = record_again(c.truth, in_run(c, c.effects, plans.size() - 1), c.noise, gains, plans.back(), wish.seed);
  c.floors = floors_of(runs.back(), again, without_effects, c.channels);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool last = i + 1 == runs.size();
    std::string name = "run_" + kinds[i] + (last && kinds[i] == "dwell" ? "_again" : "") + ".csv";
    (last ? c.holdout : c.fit).push_back({std::move(name), std::move(runs[i])});
  }
  return c;
}

}  // namespace feedtwin::challenge
