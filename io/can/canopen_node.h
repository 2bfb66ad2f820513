#pragma once
// One axis as a CANopen drive: CiA 301 slave, CiA 402 in cyclic synchronous torque mode. Pure: no clock, no socket.
//
// Torque that comes in an RPDO before SYNC k is latched at SYNC k and acts in the first tick that begins after it; TPDO 1 at
// SYNC k carries the position of the last tick that ended before it, and object 2004, mappable, how many ticks that were.
// Positions are i32 and wrap every 2^32 counts. Quick stop: the drive brakes along the ramp of 6085 (rt/quick_stop.h).

#include <array>
#include <atomic>
#include <cstdint>

#include "io/can/device.h"
#include "io/can/drive_state.h"
#include "io/can/emergency.h"
#include "io/can/heartbeat.h"
#include "io/can/object_values.h"
#include "io/can/pdo.h"
#include "io/can/pending_request.h"
#include "io/can/sdo_server.h"

namespace feedtwin::io::can {

enum class NmtState : std::uint8_t { stopped = 0x04, operational = 0x05, pre_operational = 0x7F };

struct CanopenCounters {
  std::uint64_t syncs = 0;
  std::uint64_t commands = 0;         ///< RPDOs used
  std::uint64_t superseded = 0;       ///< RPDOs overwritten by a newer one before SYNC
  std::uint64_t not_operational = 0;  ///< RPDOs that came out of NMT state operational
  std::uint64_t wrong_length = 0;     ///< RPDOs too short for their mapping, or remote
  std::uint64_t refused_values = 0;   ///< values in RPDOs outside their object's limits
  std::uint64_t command_losses = 0;   ///< times that 6007 acted for want of commands
  std::uint64_t saturated = 0;        ///< torque reports beyond i16
};

class CanopenNode final : public Device, private SdoObjects {
 public:
  explicit CanopenNode(const DriveIdentity& drive);

  void start(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void accept(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void report(const AxisReport& axis, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  bool take_request(AxisRequest& newest) noexcept FEEDTWIN_REALTIME override;
  bool take_machine_request(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override;
  void bus_recovered(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  void encoder_failed(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME override;
  [[nodiscard]] bool steps_the_plant(const Frame& frame) const noexcept FEEDTWIN_REALTIME override;
  void listens_to(std::span<std::uint16_t, most_ids> ids) const noexcept override;
  void add_counters(const std::string& prefix, std::vector<Counter>& counters) const override;

  [[nodiscard]] NmtState nmt_state() const noexcept { return nmt_; }
  [[nodiscard]] Cia402State drive_state() const noexcept { return drive_state_.state(); }
  [[nodiscard]] const ObjectValues& objects() const noexcept { return objects_; }
  [[nodiscard]] const CanopenCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] const SdoCounters& sdo_counters() const noexcept { return sdo_.counters(); }

 private:
  /// A process data object as its communication and mapping parameters make it.
  struct Pdo {
    int communication = 0, map = 0;  ///< entries of sub-index 0 of 14xx/18xx and 16xx/1Axx
    bool exists = false;
    std::uint16_t cob_id = 0;
    int type = 1;
    PdoMapping mapping;
    // running
    bool pending = false, sent = false;
    Frame frame{};
    std::int64_t time_ns = 0;  ///< of arrival, or of the last sending
    int syncs = 0;
  };
  /// Entries of the table that the node works with.
  struct Entries {
    int controlword, statusword, mode, mode_shown, target_torque, most_torque, torque_offset, torque_demand, torque,
        position, velocity, inputs, quick_stop_option, fault_option, abort_option, most_missed_syncs, sync_timeout,
        heartbeat_producer, heartbeat_consumer, spindle_speed, auxiliary, depth_of_cut, deceleration, ticks;
  };

  // SDO
  Abort sdo_read(std::uint16_t index, std::uint8_t sub, std::span<std::uint8_t> bytes,
                 std::size_t& length) noexcept FEEDTWIN_REALTIME override;
  Abort sdo_write(std::uint16_t index, std::uint8_t sub,
                  std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME override;
  Abort allow(int entry, std::int64_t value) noexcept FEEDTWIN_REALTIME;
  Abort allow_pdo(int entry, std::int64_t value) noexcept FEEDTWIN_REALTIME;
  void written(int entry) noexcept FEEDTWIN_REALTIME;
  void configure(Pdo& pdo, Mappable direction) noexcept FEEDTWIN_REALTIME;
  void configure_all() noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] Pdo* pdo_of(int entry, Mappable& direction, bool& mapping) noexcept FEEDTWIN_REALTIME;
  void publish_ids() noexcept FEEDTWIN_REALTIME;

  // network
  void network_command(const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void boot(FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void reset_application() noexcept FEEDTWIN_REALTIME;
  void sync(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void receive_pdo(Pdo& pdo, const Frame& frame, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  bool use(Pdo& pdo, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void take(int entry, std::int64_t value, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void transmit(Pdo& pdo, std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void send_state(FrameQueue& out) const noexcept FEEDTWIN_REALTIME;
  void supervise(std::int64_t now_ns, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void command_lost(ErrorCode code, FrameQueue& out) noexcept FEEDTWIN_REALTIME;

  // drive
  void step_drive(FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void fault(ErrorCode code, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  void show_status() noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] StopOptions stop_options() const noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] double wanted_torque_Nm() noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] std::int64_t at(int entry) const noexcept FEEDTWIN_REALTIME { return objects_.get(entry); }

  DriveIdentity drive_;
  Entries entry_;
  ObjectValues objects_;
  SdoServer sdo_;
  Emergency emergency_;
  HeartbeatProducer heartbeat_;
  HeartbeatConsumer master_;
  DriveStateMachine drive_state_;
  NmtState nmt_ = NmtState::pre_operational;
  std::array<Pdo, pdos> rpdo_{}, tpdo_{};

  AxisReport axis_;
  PendingRequest pending_;
  bool standstill_ = true;
  bool torque_limited_ = false;
  bool machine_changed_ = false;
  std::int64_t supervised_since_ns_ = 0;
  int syncs_without_command_ = 0;
  std::uint16_t last_statusword_ = 0;
  CanopenCounters counters_;
  std::array<std::atomic<std::uint16_t>, most_ids> ids_{};
};

}  // namespace feedtwin::io::can
