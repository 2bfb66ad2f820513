#include "tests/challenge/catalogue.h"

#include "tests/challenge/catalogue/tables.h"

namespace feedtwin::challenge {

double one_of(Shape& random, std::initializer_list<double> values) {
  return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

double sign(Shape& random) {
  return chance(random, 0.5) ? 1.0 : -1.0;
}

Wave wave(double amplitude, Shape& shape, std::initializer_list<double> cycles) {
  return {amplitude, one_of(shape, cycles), uniform(shape, -3.1, 3.1)};
}

Numbers numbers(const char* name, const Wave& w) {
  return {{name, w.amplitude}, {"cycles_per_rev", w.cycles_per_rev}, {"phase_rad", w.phase_rad}};
}

const std::vector<Hidden>& catalogue() {
  static const std::vector<Hidden> all = [] {
    std::vector<Hidden> joined;
    for (const auto& table : {hidden_in_transmission(), hidden_in_friction(), hidden_in_loads(), hidden_in_readings()})
      joined.insert(joined.end(), table.begin(), table.end());
    return joined;
  }();
  return all;
}

const std::vector<Hidden>& outside() {
  static const std::vector<Hidden> all = {
      {"viscous_bowl", none, true, false, 0.05, 3.0, [](Effects& e, double s, Shape, const Reach&) { e.bowl_viscous = s; },
       [](const Effects&) { return Numbers{}; }},
      {"braking_mass", none, true, false, 1.0, 30.0,
       [](Effects& e, double s, Shape, const Reach&) { e.braking_mass_kg = s; }, [](const Effects&) { return Numbers{}; }},
      {"beating_friction", none, true, false, 0.5, 30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.beat_N = s;
         e.beat_Hz = uniform(r, 0.6, 3.0);
       },
       [](const Effects&) { return Numbers{}; }},
      {"slosh", none, true, false, 0.5, 30.0,
       [](Effects& e, double s, Shape r, const Reach&) {
         e.slosh_kg = s;
         e.slosh_Hz = uniform(r, 3.0, 8.0);
       },
       [](const Effects&) { return Numbers{}; }},
      {"washboard", none, true, false, 20.0, 2000.0,
       [](Effects& e, double s, Shape, const Reach&) { e.washboard_Ns_per_m = s; },
       [](const Effects&) { return Numbers{}; }},
  };
  return all;
}

bool identifiable(const Hidden& hidden, unsigned channels) {
  // the same equations, or the same to within what any channel shows
  for (const char* id : {"encoder_eccentricity", "cyclic_lead_error", "floor_vibration", "process_force", "torque_offset"})
    if (hidden.id == id) return false;
  if (hidden.id == "cogging") return (channels & torque_sensor) != 0;
  if (hidden.id == "presliding_memory") return (channels & scale) != 0;
  return (channels & hidden.needs) == hidden.needs;
}

const Hidden* find_hidden(const std::string& id) {
  for (const auto* list : {&catalogue(), &outside()})
    for (const auto& hidden : *list)
      if (hidden.id == id) return &hidden;
  return nullptr;
}

}  // namespace feedtwin::challenge
