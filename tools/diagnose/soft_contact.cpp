#include "tools/diagnose/soft_contact.h"

#include "tools/diagnose/hypotheses/shapes.h"

namespace feedtwin::tools::diagnosis {

/// Contacts of eight slipping elements with nothing hidden left a bristle of 0.32 to 0.5 of the file's stiffness beside 14
/// to 36 N over 5 to 6 um; hidden memories, of 4 to 24 um, left one of 0.16 beside 36 N over 16 um and one of 0.03 beside 42
/// N over 12 um, which is 6 and 9 times what their friction yields on the file's bristle.
bool worth_telling(const Active& active, const plant::AxisParameters& now, const plant::AxisParameters& nominal) {
  constexpr double softened = 0.22, of_the_files_bristle = 4.5, least_N = 5.0;
  if (worth_naming(active, now)) return true;
  if (active.hypothesis->id != "presliding_memory") return false;
  const double force_N = active.q[0], distance_m = active.q[1], file_N_per_m = nominal.ball_screw.stiffness_N_per_m;
  const double yields_m = (mean(now.ball_screw.coulomb_N) + force_N) / file_N_per_m;
  return force_N > least_N && now.ball_screw.stiffness_N_per_m < softened * file_N_per_m &&
         distance_m > of_the_files_bristle * yields_m;
}

}  // namespace feedtwin::tools::diagnosis
