#!/usr/bin/env python3
"""candump's log against the server's recording, frame by frame: the TPDO 1 at a SYNC carries the position that the recorded
tick began with, and the torque of the last RPDO before that SYNC is the one that the tick used.

    compare_candump.py CANDUMP RECORDING NODE RATED_TORQUE_NM COUNTS_PER_M
"""
import csv
import struct
import sys


def main():
    dump, recording, node, rated, counts_per_m = sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]), float(sys.argv[5])
    with open(recording, newline="") as file:
        rows = [(round(float(r["position_m"]) * counts_per_m), float(r["torque_cmd_Nm"])) for r in csv.DictReader(file)]
    command, exchanges, waiting = None, [], None
    with open(dump) as file:
        for line in file:  # (1700000000.000000) vcan0 181#3716...
            identifier, _, data = line.split()[2].partition("#")
            identifier, data = int(identifier, 16), bytes.fromhex(data) if "R" not in data else b""
            if identifier == 0x200 + node and len(data) == 5:
                command = struct.unpack_from("<Hh", data)
            elif identifier == 0x080:
                waiting, command = command, None
            elif identifier == 0x180 + node and len(data) == 8:
                status, position, _ = struct.unpack("<Hih", data)
                exchanges.append((status, position, waiting))
    row, wrong, torques = 0, [], 0
    for number, (status, position, used) in enumerate(exchanges):
        enabled = status & 0x6F == 0x27
        wanted = used[1] * 1e-3 * rated if used and enabled else (None if enabled else 0.0)

        def fits(r):
            return rows[r][0] == position and (wanted is None or abs(rows[r][1] - wanted) < 1e-8)

        found = next((r for r in range(row, len(rows)) if fits(r)), None)
        if found is None:
            wrong.append((number, status, position, used))
            continue
        torques += wanted is not None and enabled
        row = found
    print(f"candump against the recording: {len(exchanges)} exchanges, {torques} torques compared, {len(wrong)} not found, "
          f"{len(set(p for _, p, _ in exchanges))} different positions")
    if wrong or torques < 500 or len(set(p for _, p, _ in exchanges)) < 500:
        sys.exit(f"first that do not fit: {wrong[:5]}")


if __name__ == "__main__":
    main()
