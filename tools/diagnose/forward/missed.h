#pragma once
// The closed loop's own question about each name: simulated without it, and with all other numbers free to make up for it,
// are the recordings less likely? What friction at reversals or one rough event asked for once is not missed then.

#include <functional>
#include <string_view>

#include "tools/diagnose/forward/ruling.h"

namespace feedtwin::tools::diagnosis {

/// Takes back, one after the other, the names that are missed least and not enough; what it changes is changed in all.
/// @param settled the fit's model as the closed loop has it
void keep_missed(const ForwardModel& forward, const Fitter& fitter, SearchResult& found, Fit& fit, Ruling& settled,
                 const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
