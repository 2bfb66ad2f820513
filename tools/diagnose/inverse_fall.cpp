// How the inverse model's residual falls from one model to one beside it: only what is another's is worked out.

#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {
namespace {

using Modelled = InverseModel::Modelled;

bool same(const Vector& one, const Vector& other) {
  return one.size() == other.size() && one == other;
}

bool same_motion_forces(const Modelled& a, const Modelled& b) {
  return a.axis.motor.inertia_kgm2 == b.axis.motor.inertia_kgm2 &&
         a.axis.ball_screw_inertia_kgm2 == b.axis.ball_screw_inertia_kgm2 && a.axis.axis.lead_m == b.axis.axis.lead_m &&
         a.axis.guide_mass_kg + a.extra.table_mass_kg == b.axis.guide_mass_kg + b.extra.table_mass_kg &&
         same(a.extra.drive_step_N, b.extra.drive_step_N);
}

/// Do both models say the same in this equation? Of a component and its sensors what raw_residual asks for.
bool same_in(const Equation& equation, const Modelled& a, const Modelled& b) {
  const auto adds_the_same = [&](Vector Contribution::* part) { return same(a.extra.*part, b.extra.*part); };
  if (equation.slip) return adds_the_same(&Contribution::slip_m);
  if (equation.power)
    return same(a.base.power_W, b.base.power_W) && adds_the_same(&Contribution::power_W) &&
           adds_the_same(&Contribution::drive_N) && adds_the_same(&Contribution::metered_drive_N);
  if (!same_motion_forces(a, b)) return false;
  if (equation.motor && !(a.axis.motor.coulomb_N == b.axis.motor.coulomb_N && same(a.base.motor_N, b.base.motor_N) &&
                          adds_the_same(&Contribution::motor_N) && adds_the_same(&Contribution::drive_N)))
    return false;
  if (equation.screw && !(same(a.base.screw_N, b.base.screw_N) && adds_the_same(&Contribution::screw_N))) return false;
  if (equation.guide && !(same(a.base.guide_N, b.base.guide_N) && adds_the_same(&Contribution::guide_N))) return false;
  const bool torque = equation.motor != equation.screw, force = equation.screw != equation.guide;
  return (!torque || adds_the_same(&Contribution::torque_sensor_N)) &&
         (!force || adds_the_same(&Contribution::force_sensor_N));
}

}  // namespace

void InverseModel::add_fall(std::size_t run, const Modelled& from, const Modelled& to, const Vector& residual,
                            Vector& rows) const {
  for (const auto& segment : segments_) {
    const auto& equation = equations_[segment.equation];
    if (segment.run != run || segment.size == 0 || same_in(equation, from, to)) continue;
    store(segment, weight(equation, to.axis, to.extra) * raw_residual(equation, run, to.axis, to.extra, to.base), rows);
    auto part = rows.segment(segment.start, segment.size);
    part = residual.segment(segment.start, segment.size) - part;
  }
}

InverseModel::Standing InverseModel::standing(const plant::AxisParameters& axis, Prepared model, Vector residual) const {
  Standing at{axis, std::move(model), std::move(residual), std::vector<Vector>(segments_.size())};
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto& [equation, run, start, size] = segments_[i];
    if (equations_[equation].motor && size > 0)
      at.balance_N[i] = balance_N(equations_[equation], run, axis, at.model.extra[run], at.model.base[run]);
  }
  return at;
}

Vector InverseModel::fall(const Standing& at, const Active& more) const {
  Vector rows = Vector::Zero(rows_);
  std::vector<Contribution> alone(tracks_.size());
  for (std::size_t run = 0; run < tracks_.size(); ++run) {
    more.hypothesis->apply({tracks_[run], at.axis, at.model.base[run]}, more.q, alone[run]);
    if (alone[run].table_mass_kg == 0.0 && alone[run].drive_step_N.size() == 0) continue;
    Contribution sum = at.model.extra[run];  // not only added to the balance: all of it again
    add(sum, alone[run]);
    add_fall(run, {at.axis, at.model.extra[run], at.model.base[run]}, {at.axis, sum, at.model.base[run]}, at.residual, rows);
    alone[run] = {};
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto& segment = segments_[i];
    const auto& equation = equations_[segment.equation];
    if (segment.size == 0) continue;
    Vector change = added(equation, segment.run, alone[segment.run]);
    if (change.size() == 0) continue;
    if (equation.motor) {
      const Vector& balance_N = at.balance_N[i];
      for (Index k = 0; k < change.size(); ++k)
        if (at_rest_[segment.run][static_cast<std::size_t>(k)] != 0)
          change[k] = beyond_coulomb_N(balance_N[k] + change[k], at.axis) - beyond_coulomb_N(balance_N[k], at.axis);
    }
    gather(segment, change, rows);
    auto part = rows.segment(segment.start, segment.size);
    if (!equation.power) part *= -weight(equation, at.axis, at.model.extra[segment.run]);
  }
  return rows;
}

}  // namespace feedtwin::tools::diagnosis
