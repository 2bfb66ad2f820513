#pragma once
// The closed loop's own question about each name: simulated without it, and with all other numbers free to make up for it,
// are the recordings less likely? What friction at reversals or one rough event asked for once is not missed then.

#include <functional>
#include <string_view>

#include "tools/diagnose/forward/ruling.h"
#include "tools/diagnose/structure.h"

namespace feedtwin::tools::diagnosis {

/// Takes back, one after the other, the names that are missed least and not enough; what it changes is changed in all.
/// @param settled the fit's model as the closed loop has it
void keep_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit, Ruling& settled,
                 const std::function<void(std::string_view)>& progress);

/// Squared tolerances: without a name the numbers are far from the file's.
inline constexpr double far_from_nominal = 60.0;
/// Squared tolerances: without it the numbers are nearer to the file's than a weight that is there leaves them (a true one
/// of 1.6 N put them 2 off).
inline constexpr double clearly_nearer = 10.0;

/// What it takes to stay, beside what the effect's own numbers cost. Where the closed loop is indifferent a name stays that
/// the inverse model asks for and unseen folds bear out, if it keeps its size (friction along the stroke of the EMPS axis);
/// not one that rests on single events (a stop of a null: 3). A torque constant without which the numbers were 129 squared
/// tolerances farther from the file was missed by 481 nats.
/// @param farther from nominal the numbers are without it, squared tolerances
[[nodiscard]] double nats_to_stay(const Found& named, double farther = 0.0);

/// Does structure that none of the catalogue explains come back where a name goes? It is missed then, however few nats that
/// is to the closed loop, which takes what is slow for the colour of its noise. Of the names that went and left a case
/// unknown three were true, and left 2.2 to 8.6 times as much (N^2) as there had been with them; three false ones 1.0 times.
/// @param missed_nats by the closed loop, which must not be as likely without it
/// @param nothing_named where it goes: less is `unknown` then
[[nodiscard]] bool leaves_structure(double missed_nats, const Structure& with, const Structure& without,
                                    bool nothing_named = false);

/// The same of a fit without the name.
/// @param with what the force equations leave over with it
[[nodiscard]] bool structure_comes_back(const Fitter& fitter, double missed_nats, const Vector& with, const Fit& without);

/// Beside the name that is missed most: no law here is that of the machine to the last per cent, and what a strong one
/// leaves over looks like a weak one that any smooth change of friction is.
[[nodiscard]] double nats_beside(const Hypothesis& h, double most_missed_nats);

}  // namespace feedtwin::tools::diagnosis
