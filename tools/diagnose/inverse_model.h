#pragma once
// The forces that the model needs for the recorded motion, against the recorded ones, component by component:
//
//   motor   u - T_I   = M_motor a + F_M + B_M v              Eq. 12
//   screw   T_I - F_I = M_screw a + F_B(x, v)                Eq. 13
//   guide   F_I       = M_table a + F_L(x, v)                Eq. 14
//   slip    scale - encoder = 0,   power = k_e0 + k_e1 |v| + k_e2 v^2 + u v      Eq. 11
//
// where a sensor is missing its neighbours' equations are added up. Friction is LuGre followed along the recorded motion
// with the plant's own step. Recorded less modelled goes through one low pass and decimation, the same for every regressor.

#include <string>
#include <vector>

#include "tools/diagnose/hypothesis.h"
#include "tools/diagnose/track.h"

namespace feedtwin::tools::diagnosis {

struct Equation {
  std::string name;  ///< "motor", "screw+guide", "motor+screw+guide", "slip", "power"
  bool motor = false, screw = false, guide = false, slip = false, power = false;
};

/// The table's own, behind a force sensor.
[[nodiscard]] bool tables_own(const Equation& equation);

/// Hamming-windowed low pass of force rows that many samples apart, to 0.4 of their rate.
[[nodiscard]] Vector low_pass_to(Index samples_a_row);

/// Mass that the equation's forces move, kg.
[[nodiscard]] double moved_kg(const Equation& equation, const plant::AxisParameters& axis);

/// Rows of one equation in one run.
struct Segment {
  std::size_t equation = 0, run = 0;
  Index start = 0, size = 0;
};

/// Forces of both contacts along one run, mean over the sample that follows.
struct ContactForces {
  Vector screw_N, guide_N;
};

/// Variances that the encoder's grid and the sensors' own noise leave in a row.
struct RowNoise {
  double acceleration = 0.0;                       ///< (m/s^2)^2
  double torque_sensor = 0.0, force_sensor = 0.0;  ///< N^2 at the table
  double slip = 0.0, power = 0.0;
};

class InverseModel {
 public:
  InverseModel(std::vector<Track> tracks, const plant::AxisParameters& nominal);

  [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }
  [[nodiscard]] const std::vector<Equation>& equations() const { return equations_; }
  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] bool power_recorded() const { return power_; }
  [[nodiscard]] const plant::AxisParameters& nominal() const { return nominal_; }
  [[nodiscard]] const RowNoise& noise() const { return noise_; }
  /// Is the axis, about this row, beyond the pre-sliding that follows a reversal or a rest? True outside force equations.
  [[nodiscard]] bool settled(Index row) const { return settled_[static_cast<std::size_t>(row)]; }
  /// Samples between two rows of a force equation, and how many are dropped at either end.
  [[nodiscard]] Index samples_a_row() const { return tracks_.front().samples_a_row; }
  static constexpr Index margin = 24;
  /// The sample at which a row stands.
  [[nodiscard]] Index sample_of(const Segment& segment, Index row) const;

  /// One of several models that are asked for at once.
  struct Asked {
    const plant::AxisParameters* axis;
    const std::vector<Active>* effects;
  };
  /// Friction of both contacts along every run, under the effects' factors: the costly part of a residual. By model.
  [[nodiscard]] std::vector<std::vector<ContactForces>> contacts(const std::vector<Asked>& models) const;
  [[nodiscard]] std::vector<ContactForces> contacts(const plant::AxisParameters& axis,
                                                    const std::vector<Active>& effects) const;
  /// What else a model says along every run.
  struct Prepared {
    std::vector<Baseline> base;
    std::vector<Contribution> extra;
  };
  [[nodiscard]] Prepared prepared(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                                  const std::vector<ContactForces>& contacts) const;
  /// A prepared model that one more effect after another is asked beside.
  struct Standing {
    const plant::AxisParameters& axis;
    Prepared model;
    Vector residual;                ///< weighted
    std::vector<Vector> balance_N;  ///< by segment, of the motor's equations: before its friction at rest takes its share
  };
  /// @param residual of that model, weighted
  [[nodiscard]] Standing standing(const plant::AxisParameters& axis, Prepared model, Vector residual) const;
  /// Fall of the residual when one more effect that does not change friction joins. Only what it touches is computed.
  [[nodiscard]] Vector fall(const Standing& at, const Active& more) const;
  /// What a model says along one run.
  struct Modelled {
    const plant::AxisParameters& axis;
    const Contribution& extra;
    const Baseline& base;
  };
  /// Puts into a run's rows how the residual falls from one model to another; rows that are the same stay as they are.
  /// @param residual the first model's own, weighted
  void add_fall(std::size_t run, const Modelled& from, const Modelled& to, const Vector& residual, Vector& rows) const;
  /// Recorded less modelled, all rows, weighted. `contacts` from the function above (or of an equal model).
  [[nodiscard]] Vector residual(const plant::AxisParameters& axis, const std::vector<Active>& effects,
                                const std::vector<ContactForces>& contacts) const;
  [[nodiscard]] Vector residual(const plant::AxisParameters& axis, const std::vector<Active>& effects) const;
  /// Whether rows carry the weight of what noise the mass lets in, as a fit needs, or are as they are, for figures.
  enum class Rows { weighted, as_they_are };
  [[nodiscard]] Vector residual(const plant::AxisParameters& axis, const Prepared& model, Rows which) const;
  /// Force commanded less force needed for the motion, run by run, at the runs' own rate: nothing filtered or weighted.
  [[nodiscard]] std::vector<Vector> force_residuals_N(const plant::AxisParameters& axis, const Prepared& model) const;
  /// What is recorded, through the same low pass.
  [[nodiscard]] Vector recorded() const;
  [[nodiscard]] Baseline baseline(const plant::AxisParameters& axis, const ContactForces& contacts, std::size_t run) const;

 private:
  /// What an effect adds to a balance of forces, a slip or a power; empty where it adds nothing.
  [[nodiscard]] Vector added(const Equation& equation, std::size_t run, const Contribution& extra) const;
  /// Force commanded or read less force needed for the motion, before the motor's Coulomb friction.
  [[nodiscard]] Vector balance_N(const Equation& equation, std::size_t run, const plant::AxisParameters& axis,
                                 const Contribution& extra, const Baseline& base) const;
  /// What the motor's Coulomb friction leaves of a balance at rest: whatever is needed within its bounds.
  [[nodiscard]] static double beyond_coulomb_N(double balance_N, const plant::AxisParameters& axis);
  [[nodiscard]] Vector raw_residual(const Equation& equation, std::size_t run, const plant::AxisParameters& axis,
                                    const Contribution& extra, const Baseline& base) const;
  /// Part of the noise is the measured acceleration's and grows with the mass: unweighted, a smaller mass would shrink it.
  [[nodiscard]] double weight(const Equation& equation, const plant::AxisParameters& axis, const Contribution& extra) const;
  [[nodiscard]] Vector recorded_side(const Equation& equation, std::size_t run) const;
  /// Standard deviation of the measured acceleration about a smooth one, and the share of an equation's noise that it makes.
  void weigh_noise();
  void find_settled();
  /// What is said sample by sample, row by row: the low pass, or the mean over a meter's window.
  void gather(const Segment& segment, const Vector& raw, Vector& rows) const;
  void store(const Segment& segment, const Vector& raw, Vector& rows) const;

  std::vector<Track> tracks_;
  plant::AxisParameters nominal_;
  std::vector<Equation> equations_;
  std::vector<Segment> segments_;
  Vector low_pass_;
  std::vector<double> acceleration_share_;  ///< of each equation's noise variance
  RowNoise noise_;
  std::vector<bool> settled_;
  std::vector<std::vector<char>> at_rest_;  ///< by run and sample: stands, or did a sample before, or will a sample later
  Index rows_ = 0;
  bool power_ = false;
};

}  // namespace feedtwin::tools::diagnosis
