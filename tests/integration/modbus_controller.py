"""A velocity controller as a user would write it with pymodbus: closes the loop over Modbus TCP, one exchange a cycle.

modbus_controller.py PORT SECONDS [FC]   FC 23: one write-and-read a cycle (the preset); 16: write, then read
Runs the axis to and fro between -20 and +20 mm at 0.05 m/s and prints, as JSON, how well the velocity was held. Where the host
holds it up for longer than the watchdog that it asks for, the drive rightly goes into fault: it takes `enable` away, gives it
again, and has as long to be up to speed as after a reversal. A fault from before it began is cleared by its beginning.
"""

import json
import sys
import time

from pymodbus.client import ModbusTcpClient

RATED_NM = 1.27
LEAD_M = 0.005
COUNTS_PER_REV = 65536
SPEED = 0.05
TRAVEL = 0.02
WATCHDOG_MS = 50
SETTLING_S = 0.3
MIRROR = 2000  # holding registers from here read what the input registers hold


def main():
    port, seconds = int(sys.argv[1]), float(sys.argv[2])
    function = int(sys.argv[3]) if len(sys.argv) > 3 else 23
    client = ModbusTcpClient("127.0.0.1", port=port, timeout=2)
    if not client.connect():
        sys.exit("no connection")

    def exchange(words):
        if function == 23:
            reply = client.readwrite_registers(read_address=MIRROR, read_count=12, write_address=0, write_registers=words, slave=1)
        else:
            written = client.write_registers(0, words, slave=1)
            if written.isError():
                sys.exit(f"refused: {written}")
            reply = client.read_input_registers(0, 12, slave=1)
        if reply.isError():
            sys.exit(f"refused: {reply}")
        return reply.registers

    target, integral, sequence, torque_Nm = SPEED, 0.0, 0, 0.0
    settled_at, errors, torn = 0.0, [], 0
    enable, running, held_up = 1, False, 0
    ticks_before = None
    begin = time.monotonic()
    while time.monotonic() - begin < seconds:
        sequence = (sequence + 1) & 0xFFFF
        word = max(-10000, min(10000, round(torque_Nm / RATED_NM * 10000))) & 0xFFFF
        r = exchange([word, enable, sequence, WATCHDOG_MS])
        torn += r[0] != r[3]
        position = (r[1] + 65536 * r[2] - 2**31) * LEAD_M / COUNTS_PER_REV
        velocity = (r[5] - 65536 if r[5] & 0x8000 else r[5]) * 1e-4
        ticks = r[8] + 65536 * r[9]
        if ticks_before is None:
            ticks_before = ticks
        dt = (ticks - ticks_before) * 1e-3
        ticks_before = ticks
        if position > TRAVEL and target > 0 or position < -TRAVEL and target < 0:
            target, settled_at = -target, ticks * 1e-3 + SETTLING_S
        enable = 1
        if r[4] & 0x6F == 0x27:
            running = True
        elif running and r[4] & 0x4F == 0x08:
            running, enable, integral, settled_at = False, 0, 0.0, ticks * 1e-3 + SETTLING_S
            held_up += 1
        error = target - velocity
        integral = max(-0.5, min(0.5, integral + 60.0 * error * dt))
        torque_Nm = 6.0 * error + integral
        if ticks * 1e-3 > settled_at:
            errors.append(abs(error))
    exchange([0, 0, (sequence + 1) & 0xFFFF, WATCHDOG_MS])
    settled = errors[len(errors) // 10:]
    print(json.dumps({"exchanges": sequence, "torn": torn, "held_up": held_up, "mean_error_m_per_s": sum(settled) / len(settled)}))


main()
