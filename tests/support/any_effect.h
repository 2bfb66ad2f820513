#pragma once
// Random settings of effects, the ends of their ranges included.

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "plant/effects/registry.h"

namespace feedtwin::test {

using plant::EffectEntry;
using plant::EffectParameter;
using plant::EffectSetting;

inline std::string shown(const EffectSetting& setting) {
  std::ostringstream out;
  out << setting.id;
  for (const double value : setting.values) out << ' ' << value;
  for (const auto& list : setting.lists) out << " [" << list.size() << ']';
  return out.str();
}

/// Ends of the range, the preset, or anything between, small magnitudes as likely as large ones.
inline double any_value(const EffectParameter& p, std::mt19937& random) {
  const double u = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  switch (std::uniform_int_distribution<int>(0, 5)(random)) {
    case 0:
      return p.lowest;
    case 1:
      return p.highest;
    case 2:
      return p.preset.value_or(p.lowest);
    case 3:
      return p.lowest + u * (p.highest - p.lowest);
    default: {
      const double magnitude = std::pow(10.0, std::uniform_real_distribution<double>(-6.0, 3.0)(random));
      return std::clamp(p.lowest < 0.0 && u < 0.5 ? -magnitude : magnitude, p.lowest, p.highest);
    }
  }
}

/// Each effect's numbers come from a sequence of their own, so that one parameter more does not draw all others anew.
inline EffectSetting any_setting(const EffectEntry& entry, std::mt19937& seeds) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seeds()));
  EffectSetting setting{std::string(entry.id), {}, {}};
  for (const auto& p : entry.parameters) {
    if (!p.list) setting.values.push_back(any_value(p, random));
  }
  if (entry.id == "learned_residual") {
    setting.lists.resize(7);
    const auto over = std::uniform_int_distribution<std::size_t>(0, 2)(random);
    const int points = std::uniform_int_distribution<int>(1, 20)(random);
    std::uniform_real_distribution<double> step(1e-6, 0.02), force(-50.0, 50.0);
    double at = over == 0 ? -0.08 : 0.0;
    for (int i = 0; i < points; ++i) {
      setting.lists[over].push_back(at += step(random));
      setting.lists[3].push_back(force(random));
      if (random() % 2 == 0 || !setting.lists[4].empty()) setting.lists[4].resize(setting.lists[3].size(), force(random));
    }
    if (!setting.lists[4].empty()) setting.lists[4].resize(setting.lists[3].size());
    std::uniform_real_distribution<double> damping(-20.0, 100.0);
    for (const std::size_t list : {5U, 6U})
      if (random() % 2 == 0)
        for (int i = 0; i < points; ++i) setting.lists[list].push_back(damping(random));
  }
  if (entry.id == "learned_reading" || entry.id == "learned_command") {
    const bool command = entry.id == "learned_command";
    setting.lists.resize(command ? 2 : 8);
    const auto over = command ? 0 : std::uniform_int_distribution<std::size_t>(0, 3)(random);
    const auto adds_to = command ? 1 : std::uniform_int_distribution<std::size_t>(4, 7)(random);
    const int points = std::uniform_int_distribution<int>(1, 20)(random);
    std::uniform_real_distribution<double> step(1e-6, 0.05), added(-1e-3, 1e-3);
    double at = over == 3 ? 0.0 : -0.3;
    for (int i = 0; i < points; ++i)
      setting.lists[over].push_back(at += step(random)), setting.lists[adds_to].push_back(added(random));
    setting.values.front() =
        random() % 2 == 0 ? 0.0 : setting.lists[over].back() - setting.lists[over].front() + step(random);
  }
  return setting;
}

}  // namespace feedtwin::test
