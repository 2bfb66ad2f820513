"""Real Modbus clients against the real server: pymodbus closes a velocity loop, mbpoll reads, and everything goes wrong."""

import csv
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest

import program

try:
    from pymodbus.client import ModbusTcpClient
except ImportError as missing:
    print(f"skipped: python3-pymodbus is not installed ({missing})")
    sys.exit(77)

CONTROLLER = pathlib.Path(__file__).with_name("modbus_controller.py")
WATCHDOG_S = 0.05  # what modbus_controller.py asks for


def configuration(port, more=""):
    return f'[server]\nreal_time = false\ncontroller = "modbus"\n[[port]]\nkind = "modbus"\nport = {port}\n{more}'


def rows_of(server):
    with open(server.log_path, newline="", encoding="ascii") as file:
        return [{k: v if k == "drive_state" else float(v) for k, v in row.items()} for row in csv.DictReader(file)]


class Modbus(unittest.TestCase):
    def start(self, more=""):
        self.port = program.free_port()
        self.server = program.Server(configuration(self.port, more))
        self.addCleanup(self.server.__exit__)
        self.server.wait_for_port(self.port)

    def client(self):
        client = ModbusTcpClient("127.0.0.1", port=self.port, timeout=2)
        self.assertTrue(client.connect())
        self.addCleanup(client.close)
        return client

    def controller(self, seconds, *arguments):
        process = subprocess.Popen([sys.executable, CONTROLLER, str(self.port), str(seconds), *map(str, arguments)],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def inputs(self, client):
        reply = client.read_input_registers(0, 22, slave=1)
        self.assertFalse(reply.isError(), reply)
        return reply.registers

    def wait_until(self, condition, limit_s=20.0):
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.005)
        self.fail("did not come about")

    def wait_until_moving(self, observer):
        """An axis under command at a good part of its speed (0.1 mm/s units)."""
        self.wait_until(lambda: self.inputs(observer)[4] & 0x6F == 0x27
                        and 300 < abs(struct.unpack("h", struct.pack("H", self.inputs(observer)[5]))[0]))

    def test_pymodbus_closes_a_velocity_loop(self):
        for function in (23, 16):
            with self.subTest(function=function):
                self.start()
                process = self.controller(3, function)
                output, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 0, errors)
                result = json.loads(output)
                summary = self.server.stop()
                rows = rows_of(self.server)
                self.assertGreater(result["exchanges"], 200)
                self.assertEqual(result["torn"], 0)
                self.assertLess(result["mean_error_m_per_s"], 0.005, "a tenth of the speed asked for")
                travel = [row["position_m"] for row in rows]
                self.assertGreater(max(travel), 0.02)
                self.assertLess(min(travel), -0.02)
                self.assertGreater(summary["energy_J"]["ball_screw"], 0.1)
                self.assertLess(summary["energy_balance_error"], 1e-3)

    def test_mbpoll_reads_counts(self):
        if shutil.which("mbpoll") is None:
            self.skipTest("mbpoll is not installed")
        self.start()
        client = self.client()
        client.write_registers(0, [800, 1, 1, 200], slave=1)
        self.wait_until(lambda: self.inputs(client)[4] & 0x08)  # run on until the watchdog has stopped the command
        self.wait_until(lambda: self.inputs(client)[5] == 0)
        r = self.inputs(client)
        counts = r[1] + 65536 * r[2] - 2**31
        self.assertGreater(counts, 1000, "it moved")
        common = ["mbpoll", "-m", "tcp", "-p", str(self.port), "-1", "-0"]
        words = subprocess.run([*common, "-t", "3", "-r", "1", "-c", "2", "127.0.0.1"], capture_output=True, text=True, check=True)
        low, high = (int(value) for value in re.findall(r"^\[\d+\]:\s+(\d+)", words.stdout, re.M))
        self.assertEqual(low + 65536 * high - 2**31, counts)
        whole = subprocess.run([*common, "-t", "3:int", "-r", "14", "-c", "1", "127.0.0.1"], capture_output=True, text=True, check=True)
        self.assertEqual(int(re.search(r"^\[14\]:\s+(-?\d+)", whole.stdout, re.M)[1]), counts, "int32, low word first")
        big = subprocess.run([*common, "-B", "-t", "3:int", "-r", "12", "-c", "1", "127.0.0.1"], capture_output=True, text=True, check=True)
        self.assertEqual(int(re.search(r"^\[12\]:\s+(-?\d+)", big.stdout, re.M)[1]), counts, "int32, high word first")

    def test_killing_the_controller_takes_the_torque_away_and_another_takes_over(self):
        self.start()
        observer = self.client()
        first = self.controller(60)
        self.wait_until_moving(observer)
        first.send_signal(signal.SIGKILL)
        self.wait_until(lambda: self.inputs(observer)[4] & 0x4F == 0x08)  # the watchdog's fault
        self.assertEqual(self.inputs(observer)[6], 0, "no torque")
        second = self.controller(2)
        output, errors = second.communicate(timeout=60)
        self.assertEqual(second.returncode, 0, errors)
        result = json.loads(output)
        self.assertLess(result["mean_error_m_per_s"], 0.005)
        self.server.stop()
        rows = rows_of(self.server)
        driven = [row for row in rows if row["torque_cmd_Nm"] != 0.0]
        self.assertTrue(driven)
        for row in driven:
            self.assertLessEqual(row["input_age_us"] * 1e-6, WATCHDOG_S, row)
        faults = [row for row in rows if row["drive_state"] == "fault"]
        self.assertTrue(faults, "the recording shows it")
        ages_ms = [float(age) for age in re.findall(r"watchdog: no new command for ([\d.]+) ms", (self.server.path / "run.events.log").read_text())]
        self.assertGreaterEqual(len(ages_ms), 1 + result["held_up"], "the first one's end, and each time that the host held up the second")
        self.assertGreaterEqual(min(ages_ms), 1e3 * WATCHDOG_S)

    def test_two_controllers_that_fight_do_no_harm(self):
        self.start()
        observer = self.client()
        first = self.controller(4)
        self.wait_until_moving(observer)
        second = self.controller(4)
        output, errors = first.communicate(timeout=60)
        self.assertEqual(first.returncode, 0, errors)
        self.assertLess(json.loads(output)["mean_error_m_per_s"], 0.005)
        _, refused = second.communicate(timeout=60)
        self.assertNotEqual(second.returncode, 0)
        self.assertIn("refused", refused)
        self.server.stop()
        self.assertNotIn("fault", {row["drive_state"] for row in rows_of(self.server)})

    def test_slow_loris_and_rubbish_while_the_loop_runs(self):
        self.start("request_time_s = 0.2\nmax_clients = 16\n")
        observer = self.client()
        process = self.controller(4)
        self.wait_until_moving(observer)
        stop = threading.Event()

        def attack(seed):
            sockets = []
            while not stop.is_set():
                try:
                    s = socket.create_connection(("127.0.0.1", self.port), timeout=1.0)
                    s.sendall([b"\0\1\0", b"GET / HTTP/1.1\r\n\r\n", os.urandom(300), b"\0\1\0\0\0\x06\1\3\0\0\0"][seed % 4])
                    sockets.append(s)  # half-open: never closed by this side
                except OSError:
                    pass
                seed += 1
                while len(sockets) > 30:
                    sockets.pop(0).close()
                time.sleep(0.002)
            for s in sockets:
                s.close()

        threads = [threading.Thread(target=attack, args=(n,)) for n in range(2)]
        for thread in threads:
            thread.start()
        output, errors = process.communicate(timeout=60)
        stop.set()
        for thread in threads:
            thread.join()
        self.assertEqual(process.returncode, 0, errors)
        self.assertLess(json.loads(output)["mean_error_m_per_s"], 0.005)
        summary = self.server.stop()
        counted = "\n".join(summary["reasons"]) + self.server.output
        self.assertNotIn("fault", {row["drive_state"] for row in rows_of(self.server)}, counted)

    def test_a_reader_sees_exceptions_and_not_silence(self):
        self.start()
        client = self.client()
        for address, count, code in ((16, 1, 2), (1999, 2, 2), (0, 17, 2)):
            reply = client.read_holding_registers(address, count, slave=1)
            self.assertTrue(reply.isError())
            self.assertEqual(reply.exception_code, code, (address, count))
        reply = client.read_coils(0, 1, slave=1)
        self.assertTrue(reply.isError())
        self.assertEqual(reply.exception_code, 1)


if __name__ == "__main__":
    unittest.main()
