// Hidden effects of motor, transmission and encoder.

#include "tests/challenge/catalogue/tables.h"

namespace feedtwin::challenge {

std::vector<Hidden> hidden_in_transmission() {
  return {
      {"cogging",
       none,
       true,
       false,
       5e-4,
       0.04,
       [](Effects& e, double s, Shape r, const Reach&) { e.cogging = wave(s, r, {4, 6, 8, 12, 18, 24}); },
       [](const Effects& e) { return numbers("amplitude_Nm", e.cogging); },
       {"rev_ripple"}},
      {"torque_ripple", none, true, false, 0.005, 0.15,
       [](Effects& e, double s, Shape r, const Reach&) { e.torque_ripple = wave(s, r, {1, 2, 4, 6, 12}); },
       [](const Effects& e) { return numbers("relative_amplitude", e.torque_ripple); }},
      {"rev_ripple",
       torque_sensor,
       true,
       false,
       0.4,
       12.0,
       [](Effects& e, double s, Shape r, const Reach&) { e.rev_ripple = wave(s, r, {1, 2, 3.37, 5.61}); },
       [](const Effects& e) { return numbers("amplitude_N", e.rev_ripple); },
       {"cogging"}},
      {"encoder_eccentricity",
       scale,
       false,
       false,
       1e-6,
       2e-5,
       [](Effects& e, double s, Shape r, const Reach&) { e.encoder_eccentricity = wave(s, r, {1, 1, 2}); },
       [](const Effects& e) { return numbers("amplitude_m", e.encoder_eccentricity); },
       {"cyclic_lead_error"}},
      {"cyclic_lead_error",
       scale,
       false,
       false,
       3e-7,
       4e-6,
       [](Effects& e, double s, Shape r, const Reach&) { e.cyclic_lead_error = wave(s, r, {1, 1, 2}); },
       [](const Effects& e) { return numbers("amplitude_m", e.cyclic_lead_error); },
       {"encoder_eccentricity"}},
      {"lead_error",
       scale,
       false,
       false,
       2e-5,
       3e-4,
       [](Effects& e, double s, Shape r, const Reach&) { e.lead_error = sign(r) * s; },
       [](const Effects& e) { return Numbers{{"relative_error", e.lead_error}}; },
       {"sensor_gain"}},
      {"screw_growth", scale, false, false, 2e-5, 1.5e-4,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.screw_growth = s;
         e.screw_growth_s = uniform(r, 2.0, 6.0);
       },
       [](const Effects& e) {
         return Numbers{{"relative_growth", e.screw_growth},
                        {"time_constant_s", e.screw_growth_s},
                        {"fixed_end_m", e.screw_fixed_end_m}};
       }},
      {"backlash",
       scale,
       false,
       false,
       8e-7,
       1.2e-5,
       [](Effects& e, double s, Shape, const Reach&) { e.gap_m = s; },
       [](const Effects& e) { return Numbers{{"gap_m", e.gap_m}}; },
       {"presliding_memory", "screw_compliance"}},
      {"screw_compliance",
       scale,
       false,
       false,
       0.5,
       1.0,
       [](Effects&, double, Shape, const Reach&) {},  // the axis itself is made compliant
       [](const Effects&) { return Numbers{}; },
       {"backlash", "presliding_memory"}},
  };
}

}  // namespace feedtwin::challenge
