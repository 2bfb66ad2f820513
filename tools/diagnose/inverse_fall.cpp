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

Vector InverseModel::fall(const plant::AxisParameters& axis, const Prepared& model, const Vector& residual,
                          const Active& more) const {
  Vector rows = Vector::Zero(rows_);
  for (std::size_t run = 0; run < tracks_.size(); ++run) {
    Contribution alone;
    more.hypothesis->apply({tracks_[run], axis, model.base[run]}, more.q, alone);
    Contribution sum = model.extra[run];
    add(sum, alone);
    add_fall(run, {axis, model.extra[run], model.base[run]}, {axis, sum, model.base[run]}, residual, rows);
  }
  return rows;
}

}  // namespace feedtwin::tools::diagnosis
