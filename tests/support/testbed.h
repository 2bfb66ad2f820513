#pragma once
// The source's testbed (section 3.1) as the plant makes it: the runs of section 3.2 with the sensors' noise and converters,
// a 10 Hz power meter, and an encoder that starts anywhere within a count.

#include <vector>

#include "plant/parameters.h"
#include "tests/support/made_case.h"
#include "tools/recording/case.h"

namespace feedtwin::tests {

/// Which sensors a testbed has.
enum class Sensors {
  paper,     ///< torque and force through 16 bits, power at 10 Hz with noise
  practice,  ///< as in the made practice cases: white noise of 0.6 mN m and 60 mN, an exact meter
};

/// Stribeck and loss curves (stair), hysteresis (two slow runs within a few and within tens of micrometres), and the sine of
/// section 3.3.
[[nodiscard]] std::vector<tools::Recording> testbed_runs(const plant::AxisParameters& axis, Sensors sensors, unsigned seed);

/// The runs as a case whose axis file is off: every number that identification looks for times a factor of up to
/// 1 +- `off`.
[[nodiscard]] tools::Case testbed_case(const plant::AxisParameters& axis, Sensors sensors, unsigned seed, double off);

}  // namespace feedtwin::tests
