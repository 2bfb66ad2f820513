#pragma once
// A point or direction in the machine's space, m.

#include <cmath>

namespace feedtwin::controllers::gcode {

struct Point {
  double x = 0.0, y = 0.0, z = 0.0;

  [[nodiscard]] double operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
  [[nodiscard]] double& operator[](int axis) noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
  friend Point operator+(const Point& a, const Point& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(const Point& a, const Point& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(double f, const Point& a) noexcept { return {f * a.x, f * a.y, f * a.z}; }
  friend bool operator==(const Point&, const Point&) = default;
};

[[nodiscard]] inline double dot(const Point& a, const Point& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline double length(const Point& a) noexcept {
  return std::sqrt(dot(a, a));
}

}  // namespace feedtwin::controllers::gcode
