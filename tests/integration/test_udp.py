"""The UDP port of the real server: a controller in lockstep gets the same run every time, a free-running one is answered."""

import csv
import math
import socket
import struct
import time
import unittest

import program

REQUEST = struct.Struct("<4sBBBBIIQ")
AXIS_IN = struct.Struct("<dHHI")
REPLY = struct.Struct("<4sBBBBIIQQQq")
AXIS_OUT = struct.Struct("<qddH6x")


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def configuration(port, pace):
    return (f'[server]\nreal_time = false\ncontroller = "udp"\npace = "{pace}"\n'
            f'[[port]]\nkind = "udp"\nport = {port}\n')


class Controller:
    def __init__(self, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.socket.settimeout(0.5)
        self.sequence = 0

    def exchange(self, torque_Nm, tries=40):
        """Sends a torque, again if no reply comes; returns (tick, counts, velocity, torque, statusword)."""
        self.sequence += 1
        request = REQUEST.pack(b"FTWN", 1, 1, 1, 0, self.sequence, 0, 7) + AXIS_IN.pack(torque_Nm, 1, 500, 0)
        for _ in range(tries):
            try:
                self.socket.send(request)
                while True:
                    bytes_in = self.socket.recv(4096)
                    head = REPLY.unpack_from(bytes_in)
                    if head[5] == self.sequence:
                        return head[8], *AXIS_OUT.unpack_from(bytes_in, REPLY.size)
            except (ConnectionRefusedError, TimeoutError):
                time.sleep(0.02)  # not there yet
        raise RuntimeError("no reply")


class Udp(unittest.TestCase):
    def lockstep_run(self, pause):
        port = free_port()
        with program.Server(configuration(port, "lockstep")) as server:
            controller = Controller(port)
            seen = []
            for step in range(1000):
                seen.append(controller.exchange(0.3 * math.sin(0.02 * step)))
                if pause and step % 200 == 0:
                    time.sleep(0.05)
            controller.socket.close()
            summary = server.stop()
            with open(server.log_path, newline="", encoding="ascii") as file:
                columns = ("time_s", "torque_cmd_Nm", "position_m", "power_W", "drive_state")
                rows = [tuple(row[c] for c in columns) for row in csv.DictReader(file)]
        return seen, summary, rows

    def test_lockstep_is_the_same_run_however_long_the_controller_thinks(self):
        seen, summary, rows = self.lockstep_run(False)
        self.assertEqual(len(rows), 1000)
        self.assertEqual(summary["ticks"], 1000)
        self.assertEqual([s[0] for s in seen], list(range(seen[0][0], seen[0][0] + 1000)), "one tick a request")
        self.assertGreater(max(s[1] for s in seen) - min(s[1] for s in seen), 10000, "it moves")
        again, _, rows_again = self.lockstep_run(True)
        self.assertEqual(seen, again)
        self.assertEqual(rows, rows_again)

    def test_free_running_the_reply_comes_with_the_tick(self):
        port = free_port()
        with program.Server(configuration(port, "free-running")) as server:
            controller = Controller(port)
            first = controller.exchange(0.2)
            ticks = [controller.exchange(0.2)[0] for _ in range(300)]
            last = controller.exchange(0.0)
            controller.socket.close()
            summary = server.stop()
        self.assertEqual(ticks, sorted(set(ticks)), "never two replies of one tick")
        self.assertGreater(last[1] - first[1], 1000)
        self.assertEqual(last[4] & 0x6F, 0x27)
        self.assertGreater(summary["ticks"], 300)


if __name__ == "__main__":
    unittest.main()
