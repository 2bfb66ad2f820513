"""The machine tool: the machine verb's options and wrong input, sweeps over MPI ranks, and the same machine under serve."""

import csv
import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import tempfile
import time
import unittest

import program

MACHINE = program.SOURCE / "controllers/gcode/examples/channel.toml"


class MachineVerb(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="feedtwin-test-")
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def result(self, *arguments, **options):
        answer = program.run("machine", *arguments, "--json", self.path / "m.json", **options)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return json.loads((self.path / "m.json").read_text())

    def wrong(self, *arguments):
        answer = program.run("machine", *arguments)
        self.assertEqual(answer.returncode, 2, answer.stdout)
        self.assertEqual(len(answer.stderr.strip().splitlines()), 1, answer.stderr)
        return answer.stderr

    def test_options_and_configuration_in_any_order(self):
        energies = [self.result(*arguments)["energy_J"]["total"] for arguments in (
            (MACHINE, "--set", "auxiliary.pump_W=20", "--set", "spindle.motor=B"),
            ("--set", "auxiliary.pump_W=20", "--set", "spindle.motor=B", MACHINE),
            ("--set", "auxiliary.pump_W=20", MACHINE, "--set", "spindle.motor=B"))]
        self.assertEqual(len(set(energies)), 1, energies)
        sweeps = [self.result(*arguments)["sec_fit"] for arguments in (
            (MACHINE, "--sweep", "process.mrr_mm3_per_s=2,5"), ("--sweep", "process.mrr_mm3_per_s=2,5", MACHINE))]
        self.assertEqual(sweeps[0], sweeps[1])

    def test_wrong_input_is_one_line_that_names_the_place(self):
        self.assertIn("nowhere.toml", self.wrong(self.path / "nowhere.toml"))
        self.assertIn("tool.teth", self.wrong("--set", "tool.teth=3"))
        self.assertIn("tool.teeth", self.wrong("--set", "tool.teeth=0"))
        self.assertIn("auxiliary.pump_W", self.wrong("--set", "auxiliary.pump_W=nan"))
        self.assertIn("KEY=VALUE", self.wrong("--set", "tool"))
        self.assertIn("--sweep", self.wrong("--sweep", "auxiliary.pump_W=1:2"))
        self.assertIn("--sweep", self.wrong("--sweep", "auxiliary.pump_W=1:2:1"))
        self.assertIn("auxiliary.pump", self.wrong("--sweep", "auxiliary.pump=1,2"))
        self.assertIn("workpiece.x_high_m", self.wrong("--set", "workpiece.x_high_m=-1"))
        self.assertIn("process.mrr_mm3_per_s", self.wrong("--set", "process.mrr_mm3_per_s=1", "--set", "workpiece.top_m=-1"))
        self.assertIn("m.json", self.wrong("--json", self.path / "no" / "m.json"))
        bad = self.path / "bad.toml"
        bad.write_text("[spindle]\nmotor = \"A\"\ninertia = 1\n")
        self.assertIn("bad.toml:3: spindle.inertia", self.wrong(bad))
        gcode = self.path / "bad.ngc"
        for text, place in (("G21\nG1 X1 F100\nG33 X2\n", "bad.ngc:3:1"), ("G21 G1 X1 F100 (open\n", "bad.ngc:1:17"),
                            ("G21 G1 X1\n", "bad.ngc:1:"), ("G21\nG2 X1 Y1 R0.1 F10\n", "bad.ngc:2:")):
            gcode.write_text(text)
            self.assertIn(place, self.wrong("--program", gcode), text)

    def test_ranks_share_a_sweep_and_agree_with_one(self):
        mpirun = shutil.which("mpirun")
        if mpirun is None:
            self.skipTest("mpirun is not installed (openmpi-bin)")
        sweep = ("--sweep", "process.mrr_mm3_per_s=1:10:5", "--threads", "1")
        alone = self.result(*sweep)
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                           OMPI_MCA_btl="self,tcp", OMPI_MCA_btl_tcp_if_include="lo")
        def ranks(*arguments):
            return subprocess.run([mpirun, "-n", "3", program.PROGRAM, "machine", *map(str, arguments)], env=environment,
                                  capture_output=True, text=True, timeout=120, check=False)
        answer = ranks(*sweep, "--json", self.path / "ranks.json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        shared = json.loads((self.path / "ranks.json").read_text())
        self.assertEqual(answer.stdout.count("SEC ="), 1, "one rank tells")
        for a, b in zip(alone["sweep"], shared["sweep"], strict=True):
            self.assertEqual(a["values"], b["values"])
            self.assertEqual(a["energy_J"], b["energy_J"])
        self.assertEqual(alone["sec_fit"], shared["sec_fit"])
        self.assertEqual(ranks("--sweep", "auxiliary.pump=1,2").returncode, 2, "an error of one ends all")


def request(sequence, torques, spindle_rad_per_s=0.0, bits=0, depth_m=0.0, enable=1):
    """io/udp/datagram.h."""
    out = struct.pack("<4sBBBBIfQ", b"FTWN", 1, 1, len(torques), bits, sequence, spindle_rad_per_s, 7)
    for i, torque in enumerate(torques):
        out += struct.pack("<dHHf", torque, enable, 0, depth_m if i == 0 else 0.0)
    return out


class MachineUnderServe(unittest.TestCase):
    def text(self, *tables):
        axes = "".join(f'[{letter}]\nfile = "{program.SOURCE}/plant/axes/source_{letter}.toml"\n' for letter in "xy")
        return f'program = "{MACHINE.parent}/channel.ngc"\n' + axes + "\n".join(tables)

    def test_the_program_inside_runs_in_real_time(self):
        port = program.free_port()
        text = self.text("[server]\nreal_time = false\n", f'[[port]]\nkind = "modbus"\nport = {port}\n')
        with program.Server(text, "--duration", "2") as server:
            server.process.wait(timeout=60)
            summary = server.stop()
            with open(server.log_path, newline="", encoding="ascii") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(summary["ticks"], 2000)
        self.assertEqual(summary["controller"], "program")
        self.assertEqual(len(rows), 2000)
        energy = summary["machine"]["energy_J"]
        self.assertAlmostEqual(energy["controller"], 30.0, places=6)
        self.assertGreater(energy["spindle_electrical"], 1.0)
        self.assertAlmostEqual(sum(float(r["power_W"]) * 1e-3 for r in rows), energy["total"], delta=1e-3 * energy["total"])
        self.assertGreater(max(float(r["spindle_speed_rad_per_s"]) for r in rows), 100.0)

    def test_a_controller_over_udp_sets_spindle_and_pump_and_loses_them_when_it_goes(self):
        port = program.free_port()
        text = self.text("[server]\nreal_time = false\ncontroller = \"udp\"\nwatchdog_s = 0.3\n", f'[[port]]\nkind = "udp"\nport = {port}\n')
        with program.Server(text) as server, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as wire:
            wire.settimeout(0.5)
            wire.connect(("127.0.0.1", port))
            answered, end = 0, time.monotonic() + 30.0
            while answered < 1500 and time.monotonic() < end:
                try:
                    wire.send(request(answered + 1, [0.0, 0.0], 300.0, bits=0b1001))  # M3, M8
                    wire.recv(2048)
                    answered += 1
                except (ConnectionRefusedError, TimeoutError):
                    time.sleep(0.02)
            time.sleep(2.0)
            summary = server.stop()
            with open(server.log_path, newline="", encoding="ascii") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(answered, 1500)
        self.assertGreater(max(float(r["spindle_speed_rad_per_s"]) for r in rows), 299.0)
        self.assertTrue(any(r["pump_on"] == "1" for r in rows))
        self.assertEqual(rows[-1]["pump_on"], "0")
        self.assertLess(float(rows[-1]["spindle_speed_rad_per_s"]), 1.0, "the watchdog stops the spindle too")
        self.assertGreater(summary["machine"]["energy_J"]["pump"], 5.0)


if __name__ == "__main__":
    unittest.main()
