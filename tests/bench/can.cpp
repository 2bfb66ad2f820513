// What the CAN codecs cost an axis in one tick: command in, SYNC, request out, report in, frames out.

#include <benchmark/benchmark.h>

#include "io/can/canopen_node.h"
#include "io/can/odrive_node.h"

namespace {

using namespace feedtwin::io;
using namespace feedtwin::io::can;

Frame frame(int id, std::initializer_list<int> bytes) {
  Frame made;
  made.id = static_cast<std::uint16_t>(id);
  for (const int byte : bytes) made.data[made.length++] = static_cast<std::uint8_t>(byte);
  return made;
}

void empty(FrameQueue& out) {
  for (; !out.empty(); out.pop()) benchmark::DoNotOptimize(out.front());
}

void CanopenAxisTick(benchmark::State& state) {
  CanopenNode node(DriveIdentity{});
  FrameQueue out;
  AxisRequest request;
  AxisReport axis;
  std::int64_t now_ns = 0;
  const Frame sync = frame(0x80, {});
  node.accept(frame(0, {1, 0}), now_ns, out);
  for (const int word : {6, 7, 15}) {
    node.accept(frame(0x201, {word, 0, 0, 0, 10}), now_ns, out);
    node.accept(sync, now_ns, out);
  }
  if (node.drive_state() != Cia402State::operation_enabled) state.SkipWithError("not enabled");
  Frame command = frame(0x201, {15, 0, 0, 0, 10});
  for (auto _ : state) {
    now_ns += 1'000'000;
    store(command, 2, static_cast<std::int16_t>(axis.encoder_counts & 0xFF));
    node.accept(command, now_ns, out);
    node.accept(sync, now_ns, out);
    node.take_request(request);
    benchmark::DoNotOptimize(request);
    axis.encoder_counts += 37;
    axis.torque_Nm = request.torque_Nm;
    axis.sequence = request.sequence;
    node.report(axis, now_ns, out);
    empty(out);
  }
}
BENCHMARK(CanopenAxisTick);

void OdriveAxisTick(benchmark::State& state) {
  OdriveNode node(OdriveSettings{.node_id = 1});
  FrameQueue out;
  AxisRequest request;
  AxisReport axis;
  std::int64_t now_ns = 0;
  node.accept(frame(0x27, {8, 0, 0, 0}), now_ns, out);
  Frame command = frame(0x2E, {0, 0, 0, 0});
  for (auto _ : state) {
    now_ns += 1'000'000;
    store(command, 0, static_cast<float>(axis.encoder_counts & 0xFF) * 1e-3F);
    node.accept(command, now_ns, out);
    node.take_request(request);
    benchmark::DoNotOptimize(request);
    axis.encoder_counts += 37;
    node.report(axis, now_ns, out);
    empty(out);
  }
}
BENCHMARK(OdriveAxisTick);

void SdoExpeditedRead(benchmark::State& state) {
  CanopenNode node(DriveIdentity{});
  FrameQueue out;
  const Frame ask = frame(0x601, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0});
  for (auto _ : state) {
    node.accept(ask, 0, out);
    empty(out);
  }
}
BENCHMARK(SdoExpeditedRead);

}  // namespace

BENCHMARK_MAIN();
