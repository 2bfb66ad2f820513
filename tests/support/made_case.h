#pragma once
// Recordings that the plant itself made, under a cascade: what identification must find its way back from.

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "controllers/cascade.h"
#include "controllers/motion.h"
#include "plant/integrator.h"
#include "plant/parameter_table.h"
#include "plant/parameters.h"
#include "tools/recording/case.h"

namespace feedtwin::tests {

/// What a run of the made testbed looks like.
struct MadeRun {
  std::string motion = "sine";
  controllers::MotionSettings settings{};
  double duration_s = 2.0;
  bool sensors = true;  ///< scale, torque, force, power
  bool quantised = true;
  bool scale_at_table = false;                        ///< the scale shows the table itself, not what the encoder shows
  bool forces_before_command = false;                 ///< torque and force are read before the row's command sets in
  double torque_noise_Nm = 0.0, force_noise_N = 0.0;  ///< of the two sensors
  double torque_grid_Nm = 0.0, force_grid_N = 0.0;    ///< of their converter; 0: none
  double power_noise_W = 0.0, power_grid_W = 0.0;     ///< of the meter's readings
  plant::Resolution resolution = plant::tenth_of_a_count;
  unsigned seed = 1;
};

[[nodiscard]] tools::Recording make_recording(const plant::AxisParameters& axis, const MadeRun& run,
                                              const controllers::CascadeGains& gains = {});

/// In place of what was measured: instants of the drive's power law (Eq. 11) by the recorded command, as a meter that is
/// sampled with the controller averages them over 100 ms.
void compute_power_from_command(std::vector<tools::Recording>& runs, const plant::AxisParameters& axis);

/// An effect of the plant with these numbers, the others at their presets.
[[nodiscard]] plant::EffectSetting effect(std::string_view id,
                                          std::initializer_list<std::pair<std::string_view, double>> values);

/// Two short runs to learn from and one to prove it on, without sensors beside the encoder.
[[nodiscard]] tools::Case short_case(const plant::AxisParameters& truth, const plant::AxisParameters& nominal);

/// A folder below the test's temporary one, gone with the object.
class ScratchFolder {
 public:
  explicit ScratchFolder(std::string_view name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::string operator/(std::string_view file) const { return (path_ / file).string(); }
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// What an InputError says; empty where none is thrown.
[[nodiscard]] std::string complaint_of(const std::function<void()>& action);

}  // namespace feedtwin::tests
