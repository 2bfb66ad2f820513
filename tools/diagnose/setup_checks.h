#pragma once
// What a wrong wire or a typo does mimics everything, so it is looked for first: a signal in reverse, counts that
// are lost on the way, a lead that is not the screw's, a meter that averages for longer than the file says.

#include <string>
#include <string_view>
#include <vector>

#include "tools/diagnose/track.h"
#include "tools/recording/case.h"

namespace feedtwin::tools::diagnosis {

struct SetupFault {
  std::string id, component, channel, sentence;
  struct Number {
    std::string name;  ///< as in the plant's registry
    double value = 0.0, half_width = 0.0;
  };
  std::vector<Number> parameters;
};

/// Finds the faults and takes them out of the recordings and the axis, so that the rest of the diagnosis sees them no more.
[[nodiscard]] std::vector<SetupFault> mend_setup(Case& data);

/// A channel of all runs times a factor, where it was recorded.
void multiply(Case& data, std::string_view name, double factor);

/// The axis shows what the recordings were mended of: they are as they were to whoever compares it with them.
void show_mended(plant::AxisParameters& axis, const std::vector<SetupFault>& faults);

}  // namespace feedtwin::tools::diagnosis
