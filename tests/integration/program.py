"""The program under test, for the scripts of this folder."""

import json
import os
import pathlib
import socket
import subprocess
import tempfile
import time

PROGRAM = os.environ.get("FEEDTWIN", str(pathlib.Path(__file__).parents[2] / "build/release/feedtwin"))
SOURCE = pathlib.Path(os.environ.get("FEEDTWIN_SOURCE", pathlib.Path(__file__).parents[2]))


def run(*arguments, **options):
    """Runs a verb to its end; returns the completed process with text output."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False, **options)


def free_port():
    """A TCP port of the loopback address that nobody uses at this moment."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    """`feedtwin serve` with a configuration text, for the length of a with block."""

    def __init__(self, configuration, *arguments):
        self.folder = tempfile.TemporaryDirectory(prefix="feedtwin-test-")
        self.path = pathlib.Path(self.folder.name)
        (self.path / "server.toml").write_text(configuration)
        self.json_path = self.path / "run.json"
        self.log_path = self.path / "run.csv"
        command = [PROGRAM, "serve", str(self.path / "server.toml"), "--json", str(self.json_path), "--log", str(self.log_path)]
        self.process = subprocess.Popen(
            [*command, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for_port(self, port, limit_s=20.0):
        """Until something accepts connections there."""
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise RuntimeError("the server ended: " + self.process.stderr.read())
            try:
                with socket.create_connection(("127.0.0.1", port), timeout=1.0):
                    return
            except OSError:
                time.sleep(0.02)
        raise RuntimeError(f"nothing listens on port {port}")

    def stop(self):
        """Ends the run as a user would, with an interrupt; returns what it wrote with --json."""
        if self.process.poll() is None:
            self.process.send_signal(2)
        self.output, self.errors = self.process.communicate(timeout=60)
        return json.loads(self.json_path.read_text()) if self.json_path.exists() else None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self.folder.cleanup()
