#include <array>

#include "tools/can_files.h"
#include "tools/check/check.h"
#include "tools/compare.h"
#include "tools/diagnose.h"
#include "tools/identify.h"
#include "tools/latency/latency.h"
#include "tools/machine/machine.h"
#include "tools/report.h"
#include "tools/serve.h"
#include "tools/simulate.h"
#include "tools/verb.h"

namespace feedtwin::tools {

std::span<const Verb> verbs() noexcept {
  static constexpr std::array all{
      Verb{"serve", "the real-time plant server: a controller outside closes the loop", prepare_serve},
      Verb{"simulate", "controller and plant off line, faster than real time, deterministic; writes a recording",
           prepare_simulate},
      Verb{"latency", "wake-up, tick and input-to-output latency of this host, beside cyclictest", prepare_latency},
      Verb{"diagnose", "locates the mismatch, names the missing physics, models it, shows the fit before and after",
           prepare_diagnose},
      Verb{"machine", "the whole virtual machine tool: G-code in, energy by component out; what-if, comparison, sweep",
           prepare_machine},
      Verb{"identify", "parameters of an axis from recordings", prepare_identify},
      Verb{"compare", "simulation against recording, per channel, with metrics and pictures", prepare_compare},
      Verb{"check", "is this host fit for real time, and what to change", prepare_check},
      Verb{"report", "a self-contained HTML page of any run, comparison or diagnosis", prepare_report},
      Verb{"can-files", "writes the CANopen drives' EDS (CiA 306) and DBC", prepare_can_files},
  };
  return all;
}

}  // namespace feedtwin::tools
