#pragma once
// What the tables of hidden effects are written with. A line of a table: id, needed channels, seen in torque, wants dwell,
// strength from, to, set, numbers, alike, number only.

#include "tests/challenge/catalogue.h"
#include "tests/challenge/chance.h"

namespace feedtwin::challenge {

using Shape = std::mt19937_64;

[[nodiscard]] double one_of(Shape& random, std::initializer_list<double> values);
[[nodiscard]] double sign(Shape& random);
[[nodiscard]] Wave wave(double amplitude, Shape& shape, std::initializer_list<double> cycles);
[[nodiscard]] Numbers numbers(const char* name, const Wave& w);

[[nodiscard]] std::vector<Hidden> hidden_in_transmission();  ///< of motor, transmission and encoder
[[nodiscard]] std::vector<Hidden> hidden_in_friction();      ///< of friction
[[nodiscard]] std::vector<Hidden> hidden_in_loads();         ///< of drive and load
[[nodiscard]] std::vector<Hidden>
hidden_in_readings();  ///< of power and sensors, of set-up, and what the numbers can take up

}  // namespace feedtwin::challenge
