#pragma once
// A model and others beside it that differ in a number each, as a Jacobian asks for them: no law is asked again that says
// the same, and no row is made anew that nothing changes.

#include "tools/diagnose/inverse_model.h"
#include "tools/diagnose/said.h"

namespace feedtwin::tools::diagnosis {

class Neighbours {
 public:
  /// @param contacts of the model; all must outlive this
  Neighbours(const InverseModel& inverse, const plant::AxisParameters& axis, const std::vector<Active>& effects,
             const std::vector<ContactForces>& contacts);

  /// The model's own, all rows, weighted.
  [[nodiscard]] const Vector& residual() const { return residual_; }
  /// residual() less the neighbour's; zero in rows that are the same.
  /// @param contacts the model's own where friction need not be followed anew
  [[nodiscard]] Vector fall(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                            const std::vector<ContactForces>& contacts) const;

 private:
  [[nodiscard]] Contribution extra_of(std::size_t run, const plant::AxisParameters& axis, const std::vector<Active>& effects,
                                      const Baseline& base, const Alike& alike) const;

  const InverseModel& inverse_;
  const plant::AxisParameters& axis_;
  const std::vector<Active>& effects_;
  const std::vector<ContactForces>& contacts_;
  std::vector<std::vector<Said>> said_;  ///< by run and effect
  InverseModel::Prepared prepared_;
  Vector residual_;
};

}  // namespace feedtwin::tools::diagnosis
