#pragma once
// What is drawn for a case.

#include <numbers>
#include <random>

namespace feedtwin::challenge {

constexpr double two_pi = 2.0 * std::numbers::pi;

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline bool chance(std::mt19937_64& random, double p) {
  return std::bernoulli_distribution(p)(random);
}

}  // namespace feedtwin::challenge
