#pragma once
// Figures inside a verb's JSON, which `report` draws: one convention for all verbs.
//
//   "figures": [ { "title": "…", "x": { "label": "time", "unit": "s" }, "y": { "label": "torque", "unit": "N m" },
//                  "series": [ { "name": "recorded", "style": "line" | "points", "x": […], "y": […] } ] } ]

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace feedtwin::tools {

struct FigureAxis {
  std::string label, unit;
};

struct FigureSeries {
  std::string name;
  std::vector<double> x, y;
  bool points = false;
};

struct Figure {
  std::string title;
  FigureAxis x, y;
  std::vector<FigureSeries> series;
};

/// A long line thinned for drawing: first, lowest, highest and last of each piece are kept, so that no peak is lost.
[[nodiscard]] FigureSeries thinned(std::string name, std::span<const double> x, std::span<const double> y,
                                   std::size_t most_points = 1600);

[[nodiscard]] nlohmann::json to_json(const Figure& figure);
[[nodiscard]] nlohmann::json to_json(const std::vector<Figure>& figures);

}  // namespace feedtwin::tools
