#include "io/can/bus_nodes.h"

#include <algorithm>
#include <array>

namespace feedtwin::io::can {
namespace {

/// Emergencies and SDO replies each say something of their own; every other frame is a state that a newer one replaces.
bool cyclic(const Frame& frame) noexcept FEEDTWIN_REALTIME {
  return frame.id > 0x180 && frame.id < 0x580;
}

}  // namespace

BusNodes::BusNodes(std::unique_ptr<Link> link, std::vector<std::unique_ptr<Device>> devices)
    : link_(std::move(link)), devices_(std::move(devices)) {}

void BusNodes::gather_ids(std::vector<std::uint16_t>& ids) const {
  ids.clear();
  std::array<std::uint16_t, Device::most_ids> own{};
  for (const auto& device : devices_) {
    device->listens_to(own);
    ids.insert(ids.end(), own.begin(), own.end());
  }
  std::ranges::sort(ids);
  const auto rest = std::ranges::unique(ids);
  ids.erase(rest.begin(), rest.end());
}

void BusNodes::start() noexcept FEEDTWIN_REALTIME {
  if (!started_) {
    started_ = true;
    for (auto& device : devices_) device->start(link_->now_ns(), fresh_);
  }
  if (link_->take_recovery()) {
    ++counters_.recoveries;
    for (auto& device : devices_) device->bus_recovered(link_->now_ns(), fresh_);
  }
}

bool BusNodes::drain(bool to_the_step) noexcept FEEDTWIN_REALTIME {
  start();
  trigger_ns_ = reply_ns_ = -1;
  ReceivedFrame received;
  bool step = false;
  const bool had_enough = !may_take_more();
  while (may_take_more() && !(step && to_the_step) && link_->receive(received)) {
    --allowance_;
    ++counters_.received;
    for (auto& device : devices_) {
      device->accept(received.frame, received.arrival_ns, fresh_);
      if (!device->steps_the_plant(received.frame)) continue;
      step = true;
      trigger_ns_ = received.arrival_ns;
    }
  }
  if (!had_enough && !may_take_more()) ++counters_.left_for_next_tick;
  const bool answers = !fresh_.empty();
  flush();
  if (trigger_ns_ >= 0 && answers && waiting_.empty()) reply_ns_ = link_->now_ns() - trigger_ns_;
  return step;
}

void BusNodes::enqueue() noexcept FEEDTWIN_REALTIME {
  for (; !fresh_.empty(); fresh_.pop()) {
    const Frame& frame = fresh_.front();
    if (cyclic(frame) && waiting_.replace(frame)) {
      ++counters_.replaced;
    } else if (!waiting_.push(frame)) {
      ++counters_.lost;
    }
  }
}

void BusNodes::flush() noexcept FEEDTWIN_REALTIME {
  enqueue();
  while (!waiting_.empty()) {
    const Sent result = link_->send(waiting_.front());
    if (result == Sent::later) {
      ++counters_.delayed;
      return;
    }
    ++(result == Sent::yes ? counters_.sent : counters_.lost);
    waiting_.pop();
  }
}

void BusNodes::report(std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME {
  renew_allowance();
  const std::int64_t now_ns = link_->now_ns();
  for (std::size_t i = 0; i < devices_.size() && i < axes.size(); ++i) devices_[i]->report(axes[i], now_ns, fresh_);
  flush();
}

bool BusNodes::take_request(std::size_t axis, AxisRequest& newest) noexcept FEEDTWIN_REALTIME {
  if (!devices_[axis]->take_request(newest)) return false;
  newest.reply_ns = reply_ns_;
  return true;
}

bool BusNodes::take_machine_request(MachineRequest& newest) noexcept FEEDTWIN_REALTIME {
  return !devices_.empty() && devices_.front()->take_machine_request(newest);
}

void BusNodes::encoder_failed(std::size_t axis) noexcept FEEDTWIN_REALTIME {
  if (axis < devices_.size()) devices_[axis]->encoder_failed(link_->now_ns(), fresh_);
}

void BusNodes::add_counters(std::vector<Counter>& all) const {
  const auto add = [&](const char* name, const char* meaning, std::uint64_t value, bool loses_data = false) {
    all.push_back({name, meaning, value, loses_data});
  };
  add("received", "frames taken from the bus", counters_.received);
  add("sent", "frames given to the adapter", counters_.sent);
  add("left_for_next_tick", "ticks in which more frames had come than one tick takes", counters_.left_for_next_tick);
  add("delayed", "ticks in which the adapter had no room (ENOBUFS)", counters_.delayed);
  add("replaced", "cyclic frames that waited and were overtaken by a newer one", counters_.replaced);
  add("lost", "frames that could not be sent", counters_.lost + fresh_.refused(), true);
  add("bus_recoveries", "times that the bus came back", counters_.recoveries, true);
  link_->add_counters(all);
  for (std::size_t i = 0; i < devices_.size(); ++i) devices_[i]->add_counters("axis " + std::to_string(i) + " ", all);
}

}  // namespace feedtwin::io::can
