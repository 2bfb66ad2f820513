"""Usage, wrong input, a killed run: what the program says and how it ends."""

import csv
import json
import pathlib
import signal
import socket
import tempfile
import time
import unittest

import program

QUIET = "[server]\nreal_time = false\n"


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="feedtwin-test-")
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def assert_wrong_input(self, result, *parts):
        self.assertEqual(result.returncode, 2, result.stderr + result.stdout)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def test_every_verb_has_help(self):
        overview = program.run("--help")
        self.assertEqual(overview.returncode, 0)
        verbs = [line.split()[0] for line in overview.stdout.split("Subcommands:")[1].splitlines() if line.strip()]
        self.assertIn("serve", verbs)
        self.assertIn("simulate", verbs)
        for verb in verbs:
            result = program.run(verb, "--help")
            self.assertEqual(result.returncode, 0, verb)
            if verb not in ("report", "can-files"):  # these write files, not numbers
                self.assertIn("--json", result.stdout, f"{verb} reports numbers")

    def test_wrong_usage(self):
        self.assert_wrong_input(program.run("sirve"))
        self.assert_wrong_input(program.run("serve", "--duration", "soon"))
        self.assert_wrong_input(program.run("simulate", "--duration", "-1"))
        self.assert_wrong_input(program.run("serve", "--controller", "pigeon", "--duration", "1"), "pigeon", "loopback")

    def test_a_configuration_that_is_not_there_or_wrong(self):
        self.assert_wrong_input(program.run("serve", self.path / "none.toml"), "none.toml")
        bad = self.path / "bad.toml"
        bad.write_text("[server]\nperiod_s = 0.001\nperiod_ms = 1\n")
        self.assert_wrong_input(program.run("serve", bad), "bad.toml:3", "server.period_ms")

    def test_a_log_folder_that_cannot_be_written(self):
        self.assert_wrong_input(program.run("serve", "--controller", "loopback", "--log", self.path / "no" / "run.csv"), "run.csv")
        self.assert_wrong_input(program.run("simulate", "--log", "/proc/run.csv"), "/proc/run.csv")

    def test_a_json_file_that_cannot_be_written_is_said(self):
        result = program.run("simulate", "--duration", 1, "--log", self.path / "s.csv", "--json", self.path / "no" / "s.json")
        self.assert_wrong_input(result, "s.json")
        self.assertFalse((self.path / "s.csv").exists(), "it is said before anything is run")

    def test_a_port_in_use(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            configuration = self.path / "taken.toml"
            configuration.write_text(QUIET + f'[[port]]\nkind = "modbus"\nport = {port}\n')
            result = program.run("serve", configuration, "--duration", 1, "--log", self.path / "run.csv")
            self.assert_wrong_input(result, "modbus", str(port), "in use")

    def test_simulate_is_deterministic_and_faster_than_real_time(self):
        for name in ("a", "b"):
            result = program.run("simulate", "--log", self.path / f"{name}.csv", "--json", self.path / f"{name}.json")
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.path / "a.csv").read_bytes(), (self.path / "b.csv").read_bytes())
        summary = json.loads((self.path / "a.json").read_text())
        self.assertEqual(summary["ticks"], 10000)
        self.assertEqual(summary["verdict"], "sound")
        self.assertLess(summary["energy_balance_error"], 1e-3)
        for key in ("wakeup_us", "tick_us", "input_age_us"):
            for share in ("p50", "p99", "p99_9", "p99_99", "max"):
                self.assertIsInstance(summary[key][share], float)
        for component in ("motor_electrical", "motor_mechanical", "ball_screw", "guide"):
            self.assertGreater(summary["energy_J"][component], 0.0)
        with open(self.path / "a.csv", newline="", encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 10000)
        travel = [float(row["position_m"]) for row in rows]
        self.assertGreater(max(travel) - min(travel), 0.03, "the loopback controller moves the table")
        error = max(abs(float(row["position_m"]) - float(row["reference_m"])) for row in rows)
        self.assertLess(error, 20e-6, "and follows its reference")

    def test_serve_runs_as_long_as_asked_and_says_whether_to_trust_it(self):
        configuration = self.path / "short.toml"
        configuration.write_text(QUIET + f'[[port]]\nkind = "modbus"\nport = {program.free_port()}\n')
        result = program.run("serve", configuration, "--controller", "loopback", "--duration", 2, "--log", self.path / "r.csv",
                             "--json", self.path / "r.json")
        summary = json.loads((self.path / "r.json").read_text())
        self.assertEqual(summary["ticks"], 2000)
        self.assertIn(summary["verdict"], ("sound", "not-valid-for-latency", "unsound"))
        self.assertEqual(result.returncode, 1 if summary["verdict"] == "unsound" else 0)
        if summary["verdict"] != "sound":
            self.assertTrue(summary["reasons"], "a verdict has its reasons")
        self.assertEqual(len((self.path / "r.csv").read_text().splitlines()), 2001)

    def test_a_killed_server_leaves_a_readable_log(self):
        port = program.free_port()
        text = QUIET + f'controller = "loopback"\n[[port]]\nkind = "modbus"\nport = {port}\n'
        with program.Server(text) as server:
            server.wait_for_port(port)
            time.sleep(1.5)
            server.process.send_signal(signal.SIGKILL)
            server.process.wait()
            lines = server.log_path.read_text().splitlines()
        self.assertGreater(len(lines), 500)
        columns = len(lines[0].split(","))
        for line in lines:
            self.assertEqual(len(line.split(",")), columns, line)

    def test_an_interrupt_ends_a_run_in_order(self):
        port = program.free_port()
        text = QUIET + f'controller = "loopback"\n[[port]]\nkind = "modbus"\nport = {port}\n'
        with program.Server(text) as server:
            server.wait_for_port(port)
            time.sleep(0.5)
            summary = server.stop()
            self.assertGreater(summary["ticks"], 100)
            self.assertIn("Verdict:", server.output)


if __name__ == "__main__":
    unittest.main()
