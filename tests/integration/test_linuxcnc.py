"""LinuxCNC drives the axis over Modbus TCP with its stock mb2hal (Route A): homes, moves in G-code, and follows.

Its servo thread has no real time here, so that a host that stands still for long makes LinuxCNC give up with a following
error; such a try is said and made again.
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import program

FILES = pathlib.Path(__file__).with_name("linuxcnc")
TRIES = 3

if shutil.which("linuxcnc") is None or shutil.which("mb2hal") is None:
    print("skipped: linuxcnc-uspace is not installed")
    sys.exit(77)


def one_try(folder, port):
    for file in FILES.iterdir():
        shutil.copy(file, folder)
    links = folder / "route_a.mb2hal.ini"
    links.write_text(links.read_text().replace("@PORT@", str(port)))
    command = ["linuxcnc", "-r", str(folder / "route_a.ini")]
    if os.geteuid() == 0:  # LinuxCNC will not run as root
        subprocess.run(["chown", "-R", "nobody", str(folder)], check=True)
        command = ["runuser", "-u", "nobody", "--", "env", f"HOME={folder}", *command]
    done = subprocess.run(command, env={**os.environ, "HOME": str(folder)}, capture_output=True, timeout=90, check=False)
    result = folder / "result.json"
    if not result.exists():
        raise RuntimeError("no result:\n" + done.stdout.decode(errors="replace") + done.stderr.decode(errors="replace"))
    return json.loads(result.read_text())


class LinuxCnc(unittest.TestCase):
    def test_route_a_follows_its_moves(self):
        for attempt in range(1, TRIES + 1):
            port = program.free_port()
            text = f'[server]\nreal_time = false\ncontroller = "modbus"\n[[port]]\nkind = "modbus"\nport = {port}\n'
            with program.Server(text) as server, tempfile.TemporaryDirectory(prefix="feedtwin-linuxcnc-") as folder:
                server.wait_for_port(port)
                result = one_try(pathlib.Path(folder), port)
                summary = server.stop()
            if result.get("enabled") and "problem" not in result:
                break
            print(f"try {attempt}: LinuxCNC gave up: {result}")
        self.assertTrue(result.get("enabled"), result)
        rms = math.sqrt(result["sum_of_squares"] / result["samples"])
        print(f"following error: {result['max_following_error_mm']:.3f} mm at most, {rms:.3f} mm rms, {result['samples']} samples")
        self.assertGreater(result["samples"], 100)
        self.assertLess(rms, 1.0)
        self.assertLess(abs(result["position_mm"]), 0.5, "it came back to zero")
        self.assertGreater(summary["energy_J"]["ball_screw"], 1.0, "it moved")


if __name__ == "__main__":
    unittest.main()
