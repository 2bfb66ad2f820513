#!/usr/bin/env python3
"""An independent CANopen master on python3-can alone: NMT, SDO, PDO remapping, the CiA 402 states, a velocity loop in cyclic
synchronous torque mode with SYNC at 1 kHz, the loss of commands and the way back. Prints what it saw; exits 1 when it is wrong.

    canopen_master.py INTERFACE [--cycles N]
"""
import argparse
import math
import struct
import sys
import time

import can

NODE = 1
NODE_SYNC, NODE_EMCY, NODE_TPDO1, NODE_RPDO1 = 0x080, 0x080 + NODE, 0x180 + NODE, 0x200 + NODE
SLOW_PDO = 0x2A1  # where TPDO 2 is moved to


class Master:
    def __init__(self, interface):
        self.bus = can.Bus(interface, interface="socketcan")
        self.newest = {}
        self.counts = {}
        self.emergencies = []

    def send(self, identifier, data=b""):
        self.bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

    def take(self, message):
        self.newest[message.arbitration_id] = bytes(message.data)
        self.counts[message.arbitration_id] = self.counts.get(message.arbitration_id, 0) + 1
        if message.arbitration_id == NODE_EMCY:
            self.emergencies.append(struct.unpack_from("<H", message.data)[0])

    def hear(self, seconds):
        """Take what comes for so long."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            message = self.bus.recv(left)
            if message is not None:
                self.take(message)

    def heard(self, identifier, seconds, what=lambda data: True):
        """The first such frame; None when none comes in time."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            message = self.bus.recv(left)
            if message is None:
                continue
            self.take(message)
            if message.arbitration_id == identifier and what(bytes(message.data)):
                return bytes(message.data)
        return None

    def wait_for(self, identifier, seconds=1.0, what=lambda data: True):
        data = self.heard(identifier, seconds, what)
        return data if data is not None else sys.exit(f"nothing came on {identifier:#x}")

    def reset(self, tries=20):
        """NMT reset, again until the node answers: a server that was just started may not listen yet."""
        for _ in range(tries):
            self.send(0x000, bytes([0x81, NODE]))
            if self.heard(0x700 + NODE, 0.5, lambda data: data == b"\0") is not None:
                return
        sys.exit("no boot-up came")

    # SDO client
    def ask(self, data):
        self.send(0x600 + NODE, bytes(data).ljust(8, b"\0"))
        return self.wait_for(0x580 + NODE)

    def read(self, index, sub=0):
        reply = self.ask([0x40, index & 0xFF, index >> 8, sub])
        if reply[0] == 0x80:
            raise RuntimeError(f"{index:#x}:{sub} aborted {struct.unpack_from('<I', reply, 4)[0]:#x}")
        if reply[0] & 2:
            return reply[4 : 8 - (reply[0] >> 2 & 3)]
        length, text, toggle = struct.unpack_from("<I", reply, 4)[0], b"", 0
        while True:
            reply = self.ask([0x60 | toggle])
            assert reply[0] >> 5 == 0 and reply[0] & 0x10 == toggle, reply.hex()
            text += reply[1 : 8 - (reply[0] >> 1 & 7)]
            toggle ^= 0x10
            if reply[0] & 1:
                assert len(text) == length, (len(text), length)
                return text

    def number(self, index, sub=0, signed=False):
        return int.from_bytes(self.read(index, sub), "little", signed=signed)

    def write(self, index, sub, value, length):
        data = [0x23 | (4 - length) << 2, index & 0xFF, index >> 8, sub] + list(value.to_bytes(length, "little", signed=value < 0))
        reply = self.ask(data)
        return 0 if reply[0] == 0x60 else struct.unpack_from("<I", reply, 4)[0]

    def write_text(self, index, text):
        reply = self.ask([0x21, index & 0xFF, index >> 8, 0] + list(struct.pack("<I", len(text))))
        assert reply[0] == 0x60, reply.hex()
        toggle = 0
        for at in range(0, len(text), 7):
            part = text[at : at + 7]
            last = at + 7 >= len(text)
            reply = self.ask(bytes([toggle | (7 - len(part)) << 1 | last]) + part)
            assert reply[0] == 0x20 | toggle, reply.hex()
            toggle ^= 0x10

    # one cycle: torque, then SYNC
    def cycle(self, controlword, per_mille=0):
        self.send(NODE_RPDO1, struct.pack("<HhB", controlword, per_mille, 10))
        self.send(NODE_SYNC)
        self.wait_for(NODE_TPDO1)
        return struct.unpack("<Hih", self.newest[NODE_TPDO1])

    def go_to(self, controlword, mask, value):
        for _ in range(50):
            status, _, _ = self.cycle(controlword)
            if status & mask == value:
                return
            time.sleep(0.001)
        sys.exit(f"controlword {controlword:#x} did not lead to {value:#x}: {status:#x}")

    def enable(self):
        self.go_to(0x06, 0x6F, 0x21)
        self.go_to(0x07, 0x6F, 0x23)
        self.go_to(0x0F, 0x6F, 0x27)


def check_objects(master):
    assert master.number(0x1000) == 0x00020192
    assert master.read(0x1008) == b"feedtwin drive"
    assert master.number(0x6502) & 1 << 9
    assert master.write(0x1017, 0, 50, 2) == 0 and master.number(0x1017) == 50
    master.write_text(0x2000, b"the axis of this test")
    assert master.read(0x2000) == b"the axis of this test"
    assert master.write(0x1000, 0, 1, 4) == 0x06010002
    assert master.write(0x6060, 0, 8, 1) == 0x06090030
    assert master.write(0x5000, 0, 1, 1) == 0x06020000
    print("objects: read and written, expedited and in segments; refusals as they should be")


def remap(master):
    """TPDO 2 to another identifier, with velocity and the tick that it is of, on every SYNC."""
    assert master.write(0x1A01, 0, 0, 1) == 0x06010000  # not while it exists
    for index, sub, value, length in (
        (0x1801, 1, 0xC0000281, 4), (0x1A01, 0, 0, 1), (0x1A01, 1, 0x606C0020, 4), (0x1A01, 2, 0x20040020, 4),
        (0x1A01, 0, 2, 1), (0x1801, 2, 1, 1), (0x1801, 1, 0x40000000 + SLOW_PDO, 4),
    ):
        assert master.write(index, sub, value, length) == 0, (hex(index), sub)
    print("TPDO 2 remapped: velocity and tick on", hex(SLOW_PDO))


def velocity_loop(master, cycles):
    """Proportional and integral on the velocity from the remapped PDO; the reference is a sine."""
    counts_per_m = master.number(0x608F, 1) / (master.number(0x2003) * 1e-9)
    amplitude, frequency, integral = 0.02, 1.0, 0.0
    errors, late, previous = [], 0, None
    period = 1e-3
    next_time = time.monotonic() + period
    torque = 0
    for k in range(cycles):
        now = time.monotonic()
        if now < next_time:
            time.sleep(next_time - now)
        elif now > next_time + period:
            late += 1
            next_time = now
        next_time += period
        master.cycle(0x0F, torque)
        if SLOW_PDO not in master.newest or previous == master.counts.get(SLOW_PDO):
            master.wait_for(SLOW_PDO)
        previous = master.counts[SLOW_PDO]
        velocity = struct.unpack_from("<i", master.newest[SLOW_PDO])[0] / counts_per_m
        reference = amplitude * math.sin(2 * math.pi * frequency * k * period)
        error = reference - velocity
        integral = max(-500.0, min(500.0, integral + 800.0 * error))
        torque = int(max(-1000, min(1000, 15000.0 * error + integral)))
        if k > cycles // 2:
            errors.append(error)
    rms = math.sqrt(sum(e * e for e in errors) / len(errors))
    print(f"velocity loop: {cycles} cycles with SYNC at 1 kHz, {late} begun late; error {rms * 1e3:.3f} mm/s rms of {amplitude / math.sqrt(2) * 1e3:.1f}")
    assert rms < 0.25 * amplitude / math.sqrt(2), "the loop does not follow"
    return torque


def quick_stop(master):
    """At full speed of a short push: the drive brakes, faster than friction would, and switches itself off at rest."""
    counts_per_m = master.number(0x608F, 1) / (master.number(0x2003) * 1e-9)

    def velocity():
        return struct.unpack_from("<i", master.newest[SLOW_PDO])[0] / counts_per_m

    for _ in range(12):
        master.cycle(0x0F, 900)
        master.wait_for(SLOW_PDO)
        time.sleep(0.001)
    began, first_tick = velocity(), struct.unpack_from("<I", master.newest[SLOW_PDO], 4)[0]
    for _ in range(200):
        status, _, torque = master.cycle(0x02)
        master.wait_for(SLOW_PDO)
        if status & 0x4F == 0x40:
            break
        time.sleep(0.001)
    ticks = struct.unpack_from("<I", master.newest[SLOW_PDO], 4)[0] - first_tick
    print(f"quick stop: from {began * 1e3:.1f} mm/s to rest and off in {ticks} ticks")
    assert began > 0.03 and status & 0x4F == 0x40 and abs(velocity()) < 1e-3, (began, hex(status), velocity())
    assert ticks < began / 9.81 / 1e-3 + 20, ticks


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("interface")
    parser.add_argument("--cycles", type=int, default=1000)
    options = parser.parse_args()
    master = Master(options.interface)

    master.reset()
    print("boot-up seen after NMT reset")
    check_objects(master)
    remap(master)

    master.send(0x000, bytes([0x01, NODE]))
    assert master.wait_for(0x700 + NODE, what=lambda data: data == b"\5"), "operational"
    master.enable()
    print("operation enabled by 06, 07, 0F")
    velocity_loop(master, options.cycles)

    # nothing more is sent: safe torque, and EMCY says why
    master.cycle(0x0F, 400)
    master.emergencies.clear()
    master.hear(0.3)
    assert 0x8250 in master.emergencies, master.emergencies
    status, position, torque = master.cycle(0x0F, 400)
    assert status & 0x4F == 0x08, hex(status)
    assert torque == 0, torque
    assert master.number(0x603F) == 0x8250 and master.number(0x1003, 1) == 0x8250
    print("silence: EMCY 8250, fault, torque 0")

    master.cycle(0x00)
    master.cycle(0x80)
    master.enable()
    assert 0 in master.emergencies, "EMCY 0000 after the reset"
    velocity_loop(master, options.cycles // 4)
    print("recovered by fault reset, moved again")
    quick_stop(master)
    master.go_to(0x00, 0x4F, 0x40)


if __name__ == "__main__":
    main()
