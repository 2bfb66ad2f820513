// What others see of the node: the identifiers that it listens to, and what it has counted.

#include "io/can/canopen_node.h"
#include "io/can/identifiers.h"

namespace feedtwin::io::can {

void CanopenNode::publish_ids() noexcept FEEDTWIN_REALTIME {
  std::size_t n = 0;
  const auto add = [&](std::uint32_t id)
                       FEEDTWIN_REALTIME { ids_[n++].store(static_cast<std::uint16_t>(id), std::memory_order_relaxed); };
  add(nmt_id);
  add(sync_id);
  add(sdo_request_id + static_cast<std::uint32_t>(drive_.node_id));
  const auto consumer = static_cast<std::uint32_t>(at(entry_.heartbeat_consumer));
  add((consumer & 0xFFFFU) != 0 ? heartbeat_id + (consumer >> 16 & 0x7FU) : no_id);
  for (const auto& pdo : rpdo_) add(pdo.exists ? pdo.cob_id : no_id);
  while (n < ids_.size()) add(no_id);
}

void CanopenNode::listens_to(std::span<std::uint16_t, most_ids> ids) const noexcept {
  for (std::size_t i = 0; i < ids_.size(); ++i) ids[i] = ids_[i].load(std::memory_order_relaxed);
}

void CanopenNode::add_counters(const std::string& prefix, std::vector<Counter>& counters) const {
  const auto add = [&](const char* name, const char* meaning, std::uint64_t value) {
    counters.push_back({prefix + name, meaning, value, false});
  };
  add("syncs", "SYNC messages seen", counters_.syncs);
  add("commands", "RPDOs used", counters_.commands);
  add("superseded", "RPDOs overwritten by a newer one before SYNC", counters_.superseded);
  add("not_operational", "RPDOs that came out of NMT state operational, not used", counters_.not_operational);
  add("wrong_length", "RPDOs too short for their mapping, not used", counters_.wrong_length);
  add("refused_values", "values in RPDOs outside their object's limits, not used", counters_.refused_values);
  add("command_losses", "times that the abort connection option (6007) acted", counters_.command_losses);
  add("torque_reports_saturated", "actual torques beyond what 6077 can say", counters_.saturated);
  add("emergencies", "EMCY messages raised", emergency_.raised());
  add("sdo_transfers", "SDO transfers completed", sdo_.counters().transfers);
  add("sdo_aborted", "SDO transfers refused", sdo_.counters().aborted);
  add("sdo_given_up", "SDO transfers left half-done by the master", sdo_.counters().given_up);
}

}  // namespace feedtwin::io::can
