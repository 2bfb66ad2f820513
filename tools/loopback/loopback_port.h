#pragma once
// A controller inside the program that talks to the plant through the same port as a real one: it gets the encoder's
// counts with a tick's report and has its torque command ready for the next tick.

#include <memory>
#include <vector>

#include "controllers/cascade.h"
#include "controllers/motion.h"
#include "io/port.h"
#include "io/registry.h"

namespace feedtwin::tools {

/// The loopback controller of one axis.
struct LoopbackSettings {
  const controllers::MotionKind* motion = nullptr;
  controllers::MotionSettings motion_settings;
  controllers::CascadeGains gains;
};

class LoopbackPort final : public io::Port {
 public:
  LoopbackPort(const std::vector<LoopbackSettings>& settings, const io::PortContext& context);

  [[nodiscard]] std::string_view name() const noexcept override { return "loopback"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<io::AxisRequest> newest) noexcept FEEDTWIN_REALTIME override;
  void send(const io::TickReport& tick, std::span<const io::AxisReport> axes) noexcept FEEDTWIN_REALTIME override;

  /// Where an axis should be at the start of a tick.
  [[nodiscard]] double reference_m(std::size_t axis, std::uint64_t tick) const noexcept;

 private:
  struct Axis {
    std::unique_ptr<controllers::Motion> motion;
    controllers::Cascade controller;
    double m_per_count;
  };
  std::vector<Axis> axes_;
  std::vector<io::AxisRequest> requests_;
  double tick_s_;
  std::uint64_t next_tick_ = 0;
  bool pending_ = false;
};

}  // namespace feedtwin::tools
