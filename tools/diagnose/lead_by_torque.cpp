#include "tools/diagnose/lead_by_torque.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace feedtwin::tools::diagnosis {
namespace {

std::optional<Estimate> number_of(const Diagnosis& told, std::string_view id, std::string_view name) {
  for (const auto& effect : told.effects)
    for (const auto& [own, estimate] : effect.parameters)
      if (effect.hypothesis->id == id && own == name) return estimate;
  return std::nullopt;
}

}  // namespace

std::optional<SetupFault> lead_by_torque(const Diagnosis& told) {
  constexpr double worth_asking = 0.02, the_same = 0.01;
  const auto constant = number_of(told, "torque_gain_error", "relative_error");
  const auto torque = number_of(told, "sensor_gain", "torque_sensor_gain");
  const auto force = number_of(told, "sensor_gain", "force_sensor_gain");
  if (!constant || !torque || std::abs(constant->value) < worth_asking) return std::nullopt;
  if (std::abs((1.0 + constant->value) * torque->value - 1.0) > the_same) return std::nullopt;
  if (force && std::abs(force->value - 1.0) > the_same) return std::nullopt;
  const double factor = 1.0 / (1.0 + constant->value);
  return SetupFault{"wrong_lead",
                    "set_up",
                    std::string(channel::torque_cmd_Nm),
                    fmt::format("the lead in the configuration is wrong: command and torque sensor make {:.4f} of the force "
                                "that they would with it, while the positions are right; it is {:.4f} times as long.",
                                1.0 / factor, factor),
                    {{"factor", factor, 0.5 * (constant->high - constant->low) * factor * factor}}};
}

}  // namespace feedtwin::tools::diagnosis
