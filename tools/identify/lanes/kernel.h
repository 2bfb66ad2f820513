#pragma once
// Closed-loop simulation of one record for a few parameter sets at once: plain arrays in and out, so that the same source
// can be compiled for several instruction sets and chosen at run time (dispatch.h).

#include <cstddef>

#include "controllers/cascade_law.h"
#include "plant/axis_model.h"
#include "tools/identify/lanes/follow_kernel.h"
#include "tools/identify/lanes/inverse_kernel.h"
#include "tools/identify/stand_in.h"

namespace feedtwin::tools::lanes {

/// A record as the kernel reads it; all arrays are `samples` long.
struct RecordView {
  std::size_t samples;
  double tick_s;
  const double* torque_Nm;                  ///< recorded command; the stand-in adds to it
  const double* position_m;                 ///< recorded
  const controllers::Reference* reference;  ///< for the cascade; nullptr: the stand-in is in its place
  controllers::CascadeGains gains;
  StandInSettings stand_in;
  double stand_in_mass_kg;
  double torque_limit_Nm;
  double start_velocity_m_per_s;
};

/// One parameter set.
struct Candidate {
  plant::AxisModel<double> model;
  double idle_W, linear_pos_Ws_per_m, linear_neg_Ws_per_m, quadratic_pos_Ws2_per_m2, quadratic_neg_Ws2_per_m2;  ///< Eq. 7
  double position_offset_m;  ///< simulated less shown position
  double force_offset_N;     ///< constant, against positive motion
  double start_offset_m;     ///< where the run starts, less where the first row says
};

/// Where results go: sample i of lane j at [i * stride + j]; nullptr: not wanted.
struct Outputs {
  std::size_t stride;
  double* torque_Nm;         ///< command held from sample i on
  double* position_m;        ///< at sample i
  double* torque_sensor_Nm;  ///< at sample i, under the command that acts from then on
  double* force_sensor_N;
  double* power_W;  ///< mean over the tick that starts at sample i
};

/// @param candidates `width` of them; @param width the kernel's number of lanes
using Kernel = void (*)(const RecordView& record, const Candidate* candidates, const Outputs& outputs);

struct KernelEntry {
  const char* instructions;
  std::size_t width;
  Kernel run;
  InverseKernel inverse;
  FollowKernel follow;
};

[[nodiscard]] KernelEntry baseline_kernel() noexcept;
[[nodiscard]] KernelEntry avx2_kernel() noexcept;
[[nodiscard]] KernelEntry avx512_kernel() noexcept;

}  // namespace feedtwin::tools::lanes
