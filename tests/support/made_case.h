#pragma once
// Recordings that the plant itself made, under a cascade: what identification must find its way back from.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "controllers/cascade.h"
#include "controllers/motion.h"
#include "plant/integrator.h"
#include "plant/parameter_table.h"
#include "plant/parameters.h"
#include "tools/recording/recording.h"

namespace feedtwin::tests {

/// What a run of the made testbed looks like.
struct MadeRun {
  std::string motion = "sine";
  controllers::MotionSettings settings{};
  double duration_s = 2.0;
  bool sensors = true;  ///< scale, torque, force, power
  bool quantised = true;
  double torque_noise_Nm = 0.0, force_noise_N = 0.0;  ///< of the two sensors
  double torque_grid_Nm = 0.0, force_grid_N = 0.0;    ///< of their converter; 0: none
  double power_noise_W = 0.0, power_grid_W = 0.0;     ///< of the meter's readings
  plant::Resolution resolution = plant::tenth_of_a_count;
  unsigned seed = 1;
};

[[nodiscard]] tools::Recording make_recording(const plant::AxisParameters& axis, const MadeRun& run,
                                              const controllers::CascadeGains& gains = {});

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
