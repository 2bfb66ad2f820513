#pragma once
// Line plots as inline SVG, for pages that stand on their own.

#include <string>
#include <vector>

namespace feedtwin::tools {

struct PlotLine {
  std::string name;
  std::vector<double> x, y;
  bool points = false;  ///< marks instead of a line
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
};

[[nodiscard]] std::string svg(const Plot& plot);
/// Text made safe to stand in HTML.
[[nodiscard]] std::string escaped(const std::string& text);

}  // namespace feedtwin::tools
