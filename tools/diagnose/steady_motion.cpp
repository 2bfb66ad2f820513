#include "tools/diagnose/steady_motion.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::tools::diagnosis {

std::vector<bool> moves_steadily(const Track& track) {
  constexpr double least_s = 0.06, least_speed = 0.02;  // of the fastest
  const auto margin = static_cast<Index>(least_s / track.sample_s);
  const double slowest_m_per_s = least_speed * track.centred_m_per_s.cwiseAbs().maxCoeff();
  std::vector<bool> steadily(static_cast<std::size_t>(track.size), true);
  const auto leave_out = [&](Index from, Index to) {
    for (Index k = std::max<Index>(0, from); k < std::min(track.size, to); ++k)
      steadily[static_cast<std::size_t>(k)] = false;
  };
  leave_out(0, InverseModel::margin);
  leave_out(track.size - InverseModel::margin, track.size);
  for (Index k = 0; k < track.size; ++k)
    if (std::abs(track.centred_m_per_s[k]) < slowest_m_per_s) leave_out(k - margin, k + margin + 1);
  return steadily;
}

std::vector<Vector> forces_left_N(const InverseModel& model, const Candidate& at) {
  return model.force_residuals_N(at.axis, model.prepared(at.axis, at.effects, model.contacts(at.axis, at.effects)));
}

}  // namespace feedtwin::tools::diagnosis
