#pragma once
// Contour error of two axes that moved together: how far the table was from the path that both references drew, whenever it
// was there (the source's Table 3).

#include <optional>
#include <span>
#include <vector>

#include "tools/identify/comparison.h"

namespace feedtwin::tools {

struct PlanarPath {
  std::span<const double> x_m, y_m;
};

/// For each row the distance to the nearest of the path's pieces within `reach` rows of it: the path as a whole may cross
/// itself.
[[nodiscard]] std::vector<double> contour_errors_m(const PlanarPath& reference, const PlanarPath& actual,
                                                   std::size_t reach = 200);

/// Of one pair of runs, recorded and simulated.
struct ContourComparison {
  std::string file_x, file_y;
  TrackingError recorded, simulated;
};

/// Pairs of runs in the cases' order. Throws InputError where the cases do not fit together: another number of runs, other
/// rows, or a run without reference_m.
[[nodiscard]] std::vector<ContourComparison> compare_contours(const CaseComparison& x, const CaseComparison& y);

[[nodiscard]] nlohmann::json to_json(const std::vector<ContourComparison>& contours);
[[nodiscard]] std::string to_text(const std::vector<ContourComparison>& contours);

}  // namespace feedtwin::tools
