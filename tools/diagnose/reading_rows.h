#pragma once
// A channel that shows what the axis does without acting on it - torque and force sensor, linear scale, power meter - row by
// row: what it shows more than the model, and what that could follow.

#include <string_view>
#include <vector>

#include "tools/diagnose/additive_model.h"
#include "tools/diagnose/inverse_model.h"

namespace feedtwin::tools::diagnosis {

/// What a reading's misfit may follow.
enum class Follows {
  reading,          ///< what is read (of the scale: the force that the screw carries): a curve
  reading_by_step,  ///< it, over and over: the steps of a converter
  reading_before,   ///< it, a while ago: a charge that leaks
  place,
  speed,
  motion,  ///< acceleration, and what it was before
  use,     ///< how hard and how fast the axis has run lately
  drive,   ///< what is commanded, and the power that it makes: crosstalk
  rest,    ///< how long the axis has stood
  several,
  time  ///< the clock, over and over
};

struct ReadingRows {
  std::string_view channel;
  bool of_force = false;
  double per_unit = 1.0;                                              ///< the misfit's unit in the channel's
  std::vector<Index> after, before;                                   ///< the model's rows that it adds to, and takes from
  std::vector<double> reading, time_s, position_m, velocity_m_per_s;  ///< of each row; likewise below
  std::vector<std::size_t> run, fold;
  Eigen::MatrixXd columns;                   ///< a column a row
  std::vector<AdditiveModel::Columns> ways;  ///< parts of these columns
  std::vector<Follows> follows;              ///< of each
  Eigen::MatrixXd numbers;                   ///< a row a row: what numbers of the model, and the catalogue, could do
  double rows_of_zero = 10.0;
};

/// Of the torque sensor, the force sensor, the command and the scale; those that are recorded. @param residual the model's
[[nodiscard]] std::vector<ReadingRows> rows_of_sensors(const InverseModel& model, double lead_m, const Vector& residual);
/// Of the power meter, one window a row; none where it was not recorded. @param residual likewise
[[nodiscard]] std::vector<ReadingRows> rows_of_power(const InverseModel& model, const Vector& residual);

}  // namespace feedtwin::tools::diagnosis
