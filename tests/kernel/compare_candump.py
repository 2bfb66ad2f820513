#!/usr/bin/env python3
"""candump's log against the server's recording, frame by frame. At a SYNC the second PDO names the tick whose state both PDOs
carry: the recording's row of that number begins with TPDO 1's position. The torque that the SYNC latched acts in the first tick
that begins after it: that row, or the next one where the tick had begun when the SYNC came; where a further SYNC comes before
that tick, its torque does.

    compare_candump.py CANDUMP RECORDING NODE RATED_TORQUE_NM COUNTS_PER_M SLOW_PDO
"""
import csv
import struct
import sys


def exchanges_of(path, node, slow_pdo):
    """At each SYNC: ticks, position, statusword, the command latched."""
    command, latched, first = None, None, None
    with open(path) as file:
        for line in file:  # (1700000000.000000) vcan0 181#3716...
            identifier, _, data = line.split()[2].partition("#")
            identifier, data = int(identifier, 16), bytes.fromhex(data) if "R" not in data else b""
            if identifier == 0x200 + node and len(data) == 5:
                command = struct.unpack_from("<Hh", data)
            elif identifier == 0x080:
                latched, command, first = command, None, None
            elif identifier == 0x180 + node and len(data) == 8:
                first = struct.unpack("<Hih", data)
            elif identifier == slow_pdo and len(data) == 8 and first:
                yield struct.unpack_from("<I", data, 4)[0], first[1], first[0], latched
                first = None


def main():
    dump, recording, node, rated, counts_per_m, slow_pdo = (
        sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]), float(sys.argv[5]), int(sys.argv[6], 0))
    with open(recording, newline="") as file:
        rows = {round(float(r["time_s"]) * 1e3): (round(float(r["position_m"]) * counts_per_m), float(r["torque_cmd_Nm"]))
                for r in csv.DictReader(file)}
    exchanges = list(exchanges_of(dump, node, slow_pdo))
    wrong, torques, next_tick, replaced = [], 0, 0, 0
    for number, (ticks, position, status, used) in enumerate(exchanges):
        if rows.get(ticks, (None,))[0] != position:
            wrong.append(("position", number, ticks, position, rows.get(ticks)))
        enabled = status & 0x6F == 0x27
        if not (enabled and used):  # a drive that brakes or is off has no torque of the controller's
            continue
        following = exchanges[number + 1] if number + 1 < len(exchanges) else (None, 0, 0, None)
        if following[0] == ticks:
            replaced += 1
            continue
        torques += 1

        def acts(command, tick):
            return tick in rows and command is not None and abs(rows[tick][1] - command[1] * 1e-3 * rated) < 1e-8

        at = [acts(used, ticks), acts(used, ticks + 1)]
        if not any(at) and following[0] == ticks + 1 and acts(following[3], ticks + 1):
            replaced += 1  # too late for the one tick, and there was a newer one before the next
        elif not any(at):
            wrong.append(("torque", number, ticks, used, rows.get(ticks), rows.get(ticks + 1)))
        next_tick += at[1] and not at[0]
    positions = len(set(e[1] for e in exchanges))
    print(f"candump against the recording: {len(exchanges)} exchanges, {positions} different positions, {torques} torques, of which "
          f"{next_tick} came while the tick was under way, {replaced} were replaced within a tick; {len(wrong)} do not fit")
    if wrong or torques < 500 or positions < 500 or next_tick + replaced > 0.1 * torques:
        sys.exit(f"first that do not fit: {wrong[:5]}")


if __name__ == "__main__":
    main()
