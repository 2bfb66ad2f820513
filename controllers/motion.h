#pragma once
// Reference motions of one axis: the source's two reciprocating ones (section 3.3), S-curve moves, and others that
// identification asks for. All start and end at rest where their name does not say otherwise.

#include <memory>
#include <span>
#include <string_view>

#include "controllers/reference.h"
#include "plant/realtime.h"

namespace feedtwin::controllers {

class Motion {
 public:
  virtual ~Motion() = default;
  /// Where the axis should be `time_s` after the start. Wait-free.
  [[nodiscard]] virtual Reference at(double time_s) const noexcept FEEDTWIN_REALTIME = 0;
};

struct RecordedPath;

/// How far and how fast a motion goes.
struct MotionSettings {
  double centre_m = 0.0;
  double amplitude_m = 0.02;                           ///< half of the travel
  double speed_m_per_s = 0.03;                         ///< largest speed
  double acceleration_m_per_s2 = 1.0;                  ///< largest, where the motion has one
  double jerk_m_per_s3 = 50.0;                         ///< largest, S-curve only
  double dwell_s = 0.2;                                ///< pause at the ends, S-curve only
  double slowest_m_per_s = 0.0;                        ///< first speed of a stair; 0: a hundredth of the largest
  int steps = 10;                                      ///< speeds of a stair, at least 2
  double hold_s = 0.4;                                 ///< at each of them
  std::shared_ptr<const RecordedPath> path = nullptr;  ///< of a recorded motion (recorded.h)
};

struct MotionKind {
  std::string_view name, meaning;
  std::unique_ptr<Motion> (*make)(const MotionSettings& settings);
  bool of_recording = false;  ///< needs a path; the other settings are of no matter
};

/// Every motion by its name: one line each in motion.cpp.
[[nodiscard]] std::span<const MotionKind> motion_kinds() noexcept;

}  // namespace feedtwin::controllers
