#include "tools/diagnose/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plant/effects/registry.h"
#include "tools/diagnose/hypotheses/registry.h"

namespace feedtwin::tools::diagnosis {

const std::vector<Hypothesis>& hypotheses() {
  static const std::vector<Hypothesis> all = registered();
  return all;
}

const Hypothesis& hypothesis(std::string_view id) {
  for (const auto& one : hypotheses())
    if (one.id == id) return one;
  throw std::logic_error("no hypothesis " + std::string(id));
}

bool possible(const Active& active, const plant::AxisParameters& axis) {
  return active.hypothesis->admissible == nullptr || active.hypothesis->admissible(active.q, axis);
}

bool worth_naming(const Active& active, const plant::AxisParameters& axis) {
  return active.hypothesis->finding == nullptr || active.hypothesis->finding(active.q, axis);
}

double nats_asked(const Active& active, bool far_off) {
  const Hypothesis& h = *active.hypothesis;
  const double asked = far_off ? h.least_missed_nats_far_off.value_or(h.least_missed_nats) : h.least_missed_nats;
  if (h.most_missed_nats_asked == nullptr || active.q.empty()) return asked;
  return std::min(asked, h.most_missed_nats_asked(active.q));
}

bool may_be_missed_enough(const Active& active, double gain) {
  constexpr double most_nats_a_gain = 10.0;
  return std::min(nats_asked(active, false), nats_asked(active, true)) < most_nats_a_gain * gain;
}

bool bears_out(const Active& active, std::string_view channel) {
  const Hypothesis& h = *active.hypothesis;
  if (!h.only_readings) return true;
  if (h.reading != nullptr) return channel == h.reading(active.q);
  return channel == channel::torque_sensor_Nm || channel == channel::force_sensor_N;
}

bool runs_may_tell(const Active& active) {
  for (std::size_t j = 0; j < active.q.size(); ++j)
    if (active.hypothesis->parameters[j].kind == Kind::amplitude &&
        std::abs(active.q[j]) > active.hypothesis->most_told_by_runs)
      return false;
  return true;
}

std::string_view component_of(const Active& active, const plant::AxisParameters& axis) {
  const Hypothesis& h = *active.hypothesis;
  if (axis.laws_on_guide() && plant::find_effect(h.id)->of_contact) return "guide";
  return h.component_for != nullptr ? h.component_for(active.q) : h.component;
}

std::string_view channel_of(const Active& active) {
  const Hypothesis& h = *active.hypothesis;
  return h.reading != nullptr ? h.reading(active.q) : h.channel;
}

std::string in_words(const Active& active, const plant::AxisParameters& axis) {
  std::string values;
  for (const auto& [name, value] : active.hypothesis->named(active.q, axis))
    values += fmt::format("{}{} {:.4g}", values.empty() ? "" : ", ", name, value);
  return fmt::format("{} ({})", active.hypothesis->id, values);
}

bool rests_on_force(const Hypothesis& hypothesis) {
  return hypothesis.channel != "scale_position_m" && hypothesis.channel != "power_W";
}

bool loads_table(const Hypothesis& hypothesis) {
  return hypothesis.component == "guide" && !hypothesis.friction;
}

bool moves_friction(const Hypothesis& hypothesis, const std::vector<Active>& effects) {
  return hypothesis.friction ||
         (loads_table(hypothesis) && std::ranges::any_of(effects, [](const Active& a) { return a.hypothesis->by_load; }));
}

bool easily_confused(const Hypothesis& one, const Hypothesis& other) {
  return std::ranges::find(one.confused_with, other.id) != one.confused_with.end() ||
         std::ranges::find(other.confused_with, one.id) != other.confused_with.end();
}

bool told_by_size_alone(const Active& active) {
  const auto far = active.hypothesis->far_from_beside;
  return far != nullptr && far(active.q);
}

bool alike(const Active& one, const Active& other, double sample_s) {
  const auto small = [sample_s](const Active& a) {
    return a.hypothesis->too_small_to_tell != nullptr && a.hypothesis->too_small_to_tell(a.q, sample_s);
  };
  return small(one) && small(other);
}

std::size_t freedom(const Hypothesis& hypothesis) {
  return static_cast<std::size_t>(
      std::ranges::count_if(hypothesis.parameters, [](const auto& p) { return fitted(p.kind); }));
}

void add(Vector& sum, const Vector& more) {
  if (sum.size() == 0)
    sum = more;
  else
    sum += more;
}

void scale(Vector& factors, const Vector& more) {
  if (factors.size() == 0)
    factors = more;
  else
    factors = factors.cwiseProduct(more);
}

void add(Contribution& sum, const Contribution& more) {
  for (const auto part :
       {&Contribution::drive_N, &Contribution::drive_step_N, &Contribution::metered_drive_N, &Contribution::motor_N,
        &Contribution::screw_N, &Contribution::guide_N, &Contribution::torque_sensor_N, &Contribution::force_sensor_N,
        &Contribution::slip_m, &Contribution::power_W})
    if ((more.*part).size() > 0) add(sum.*part, more.*part);
  for (const auto factors : {&Contribution::screw_sliding, &Contribution::screw_viscous, &Contribution::guide_sliding,
                             &Contribution::guide_viscous})
    if ((more.*factors).size() > 0) scale(sum.*factors, more.*factors);
  sum.table_mass_kg += more.table_mass_kg;
}

}  // namespace feedtwin::tools::diagnosis
