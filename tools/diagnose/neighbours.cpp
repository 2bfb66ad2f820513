#include "tools/diagnose/neighbours.h"

#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {

Neighbours::Neighbours(const InverseModel& inverse, const plant::AxisParameters& axis, const std::vector<Active>& effects,
                       const std::vector<ContactForces>& contacts)
    : inverse_(inverse), axis_(axis), effects_(effects), contacts_(contacts), said_(inverse.tracks().size()) {
  prepared_.base.resize(said_.size());
  prepared_.extra.resize(said_.size());
  parallel_for(said_.size(), [&](std::size_t run) {
    const Baseline& base = prepared_.base[run] = inverse.baseline(axis, contacts[run], run);
    for (const auto& effect : effects) {
      const bool asked = gives_forces(*effect.hypothesis);
      said_[run].push_back(asked ? said_by(effect, {inverse.tracks()[run], axis, base}) : Said{});
      add(prepared_.extra[run], said_[run].back().adds);
    }
  });
  residual_ = inverse.residual(axis, prepared_, InverseModel::Rows::weighted);
}

Contribution Neighbours::extra_of(std::size_t run, const plant::AxisParameters& axis, const std::vector<Active>& effects,
                                  const Baseline& base, const Alike& alike) const {
  Contribution sum;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const Said& known = said_[run][e];
    const bool same =
        !gives_forces(*effects[e].hypothesis) || (effects[e].q == effects_[e].q && says_the_same(known.seen, alike));
    add(sum, same ? known.adds : said_by(effects[e], {inverse_.tracks()[run], axis, base}).adds);
  }
  return sum;
}

Vector Neighbours::fall(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                        const std::vector<ContactForces>& contacts) const {
  const bool same_axis = axis == axis_, same_base = same_axis && &contacts == &contacts_;
  const Alike alike{.transmission = axis.axis == axis_.axis,
                    .ball_screw = axis.ball_screw == axis_.ball_screw,
                    .axis = same_axis,
                    .base = same_base,
                    .on_table = false};
  Vector rows = Vector::Zero(inverse_.rows());
  for (std::size_t run = 0; run < said_.size(); ++run) {
    Baseline own;
    if (!same_base) own = inverse_.baseline(axis, contacts[run], run);
    const Baseline& base = same_base ? prepared_.base[run] : own;
    const Contribution extra = extra_of(run, axis, effects, base, alike);
    inverse_.add_fall(run, {axis_, prepared_.extra[run], prepared_.base[run]}, {axis, extra, base}, residual_, rows);
  }
  return rows;
}

}  // namespace feedtwin::tools::diagnosis
