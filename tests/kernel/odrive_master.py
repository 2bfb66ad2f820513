#!/usr/bin/env python3
"""An independent ODrive CAN Simple master on python3-can alone.

    odrive_master.py INTERFACE
"""
import struct
import sys
import time

import can

NODE = 5


def main():
    bus = can.Bus(sys.argv[1], interface="socketcan")

    def send(command, data=b"", remote=False):
        bus.send(can.Message(arbitration_id=NODE << 5 | command, data=None if remote else data, is_remote_frame=remote,
                             dlc=8 if remote else len(data), is_extended_id=False))

    def wait_for(command, what=lambda data: True, seconds=1.0):
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            message = bus.recv(left)
            if message is not None and message.arbitration_id == NODE << 5 | command and not message.is_remote_frame:
                if what(bytes(message.data)):
                    return bytes(message.data)
        sys.exit(f"nothing fitting came for command {command:#x}")

    # a server that was just started may not send yet
    assert struct.unpack_from("<IB", wait_for(0x01, seconds=10.0)) == (0, 1), "idle, no error"
    send(0x0B, struct.pack("<II", 1, 1))
    send(0x07, struct.pack("<I", 8))
    wait_for(0x01, lambda data: data[4] == 8)
    start = struct.unpack_from("<f", wait_for(0x09))[0]
    for _ in range(200):
        send(0x0E, struct.pack("<f", 0.5))
        wait_for(0x09)
    revolutions = struct.unpack_from("<f", wait_for(0x09))[0] - start
    assert 0.05 < revolutions < 50, revolutions
    send(0x0A, remote=True)
    shadow, in_turn = struct.unpack("<ii", wait_for(0x0A))
    assert 0 <= in_turn < 65536 and (shadow - in_turn) % 65536 == 0
    time.sleep(0.5)  # the watchdog takes the torque away
    errors, state = struct.unpack_from("<IB", wait_for(0x01, lambda data: data[0] | data[1]))
    assert errors == 0x800 and state == 1, (hex(errors), state)
    send(0x18)
    send(0x07, struct.pack("<I", 8))
    wait_for(0x01, lambda data: data[:5] == struct.pack("<IB", 0, 8))
    send(0x02)
    errors, state = struct.unpack_from("<IB", wait_for(0x01, lambda data: data[4] == 1))
    assert errors == 0x4000, hex(errors)
    print(f"odrive: closed loop, {revolutions:.2f} revolutions under 0.5 N m, counts asked for, watchdog, clear, emergency stop")


if __name__ == "__main__":
    main()
