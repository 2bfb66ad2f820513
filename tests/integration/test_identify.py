"""compare, identify, report on a case: what they write, what they refuse, and that more processes change nothing."""

import csv
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import program

CASE = 'axis = "axis.toml"\nfit = ["run.csv"]\nholdout = ["other.csv"]\nsample_rate_Hz = 1000\n'


def read_rows(path):
    with open(path, newline="", encoding="ascii") as file:
        return list(csv.reader(file))


def write_rows(path, rows):
    with open(path, "w", newline="", encoding="ascii") as file:
        csv.writer(file).writerows(rows)


class Identify(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="feedtwin-test-")
        cls.path = pathlib.Path(cls.folder.name)
        cls.case = cls.path / "case"
        cls.case.mkdir()
        shutil.copy(program.SOURCE / "plant/axes/source_x.toml", cls.case / "axis.toml")
        for name, motion in (("run", "stair"), ("other", "sine")):
            axis = (cls.case / "axis.toml").read_text()
            configuration = f'{axis}\n[loopback]\nmotion = "{motion}"\nspeed_m_per_s = 0.1\n'
            (cls.path / "simulate.toml").write_text(configuration)
            result = program.run("simulate", cls.path / "simulate.toml", "--duration", 4, "--log", cls.case / f"{name}.csv")
            assert result.returncode == 0, result.stderr
            (cls.case / f"{name}.events.log").unlink()
        (cls.case / "case.toml").write_text(CASE)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def spoilt(self, change):
        """A copy of the case whose recording's rows went through `change`."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.path))
        shutil.copytree(self.case, folder, dirs_exist_ok=True)
        rows = read_rows(folder / "run.csv")
        changed = change(rows)
        write_rows(folder / "run.csv", rows if changed is None else changed)
        return folder

    def assert_refused(self, folder, *parts):
        for verb in ("compare", "identify"):
            out = folder / "out.json"
            axis = folder / "found.toml"
            extra = ("--out", axis) if verb == "identify" else ()
            result = program.run(verb, folder, "--json", out, *extra)
            self.assertEqual(result.returncode, 2, f"{verb}: {result.stderr}{result.stdout}")
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            self.assertEqual(result.stdout, "")
            for part in parts:
                self.assertIn(part, result.stderr, verb)
            self.assertFalse(out.exists() or axis.exists(), "nothing is written")
            self.assertEqual([p.name for p in folder.iterdir() if p.name not in ("axis.toml", "case.toml", "run.csv", "other.csv")], [])

    def test_a_case_is_compared_identified_and_reported(self):
        compared, found = self.path / "compare.json", self.path / "identify.json"
        result = program.run("compare", self.case, "--json", compared)
        self.assertEqual(result.returncode, 0, result.stderr)
        numbers = json.loads(compared.read_text())
        for key in ("peak", "rms", "rel_error", "nrmse"):
            self.assertIn(key, numbers["channels"]["torque_cmd_Nm"])
        self.assertLess(numbers["closed_loop"]["channels"]["torque_cmd_Nm"]["rel_error"], 0.02, "the right axis fits")
        self.assertIn("inverse_model", numbers)
        result = program.run("identify", self.case, "--json", found, "--out", self.path / "found.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        numbers = json.loads(found.read_text())
        for parameter in numbers["parameters"].values():
            self.assertLessEqual(parameter["ci90"][0], parameter["ci90"][1])
            self.assertLessEqual(parameter["joint_ci90"][0], parameter["ci90"][0], "what holds all at once is wider")
            self.assertGreaterEqual(parameter["joint_ci90"][1], parameter["ci90"][1])
            self.assertIn("identifiable", parameter)
        self.assertIn("torque_cmd_Nm", numbers["channels"])
        self.assertEqual(program.run("compare", self.case, "--axis", self.path / "found.toml").returncode, 0)
        titles = " ".join(figure["title"] for figure in numbers["figures"])
        for title in ("Stribeck curve", "Electrical loss", "Hysteresis"):
            self.assertIn(title, titles)
        for file in (compared, found):
            self.assertEqual(program.run("report", file).returncode, 0)
            page = file.with_suffix(".html").read_text()
            self.assertIn("</html>", page)
            self.assertNotIn("http", page)

    def test_what_is_wrong_with_a_recording_is_said_in_one_line(self):
        def column(rows, name):
            return rows[0].index(name)

        def scaled(name, factor):
            def change(rows):
                for row in rows[1:]:
                    row[column(rows, name)] = repr(float(row[column(rows, name)]) * factor)
            return change

        def each(name, value):
            def change(rows):
                for row in rows[1:]:
                    row[column(rows, name)] = value
            return change

        def cut_in_a_row(rows):
            return rows[:500] + [rows[500][:2]]

        def nan(rows):
            rows[300][column(rows, "position_m")] = "nan"

        def swap(rows):
            rows[300], rows[301] = rows[301], rows[300]

        def twice(rows):
            rows.insert(300, rows[300])

        def without(name):
            def change(rows):
                at = column(rows, name)
                return [row[:at] + row[at + 1:] for row in rows]
            return change

        self.assert_refused(self.spoilt(cut_in_a_row), "run.csv:501")
        self.assert_refused(self.spoilt(lambda rows: []), "run.csv")
        self.assert_refused(self.spoilt(lambda rows: rows[:1]), "run.csv")
        self.assert_refused(self.spoilt(lambda rows: rows[:100]), "run.csv", "at least 200")
        self.assert_refused(self.spoilt(each("position_m", "0.01")), "run.csv", "position_m", "constant")
        self.assert_refused(self.spoilt(nan), "run.csv:301", "position_m")
        self.assert_refused(self.spoilt(swap), "run.csv:302", "time_s")
        self.assert_refused(self.spoilt(twice), "run.csv:302", "time_s", "twice")
        self.assert_refused(self.spoilt(without("torque_cmd_Nm")), "run.csv", "torque_cmd_Nm")
        for name in ("position_m", "torque_cmd_Nm", "torque_sensor_Nm", "force_sensor_N", "power_W"):
            for factor in (1e3, 1e-3):
                self.assert_refused(self.spoilt(scaled(name, factor)), "run.csv", "units?")

    def test_a_case_that_is_not_there_or_wrong(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.path))
        self.assert_refused(folder, "case.toml")
        (folder / "case.toml").write_text(CASE)
        self.assert_refused(folder, "axis.toml")

    def test_report_refuses_what_no_verb_wrote(self):
        for name, text in (("empty", ""), ("cut", '{"verb": "identify",'), ("list", "[1, 2]")):
            file = self.path / f"{name}.json"
            file.write_text(text)
            result = program.run("report", file)
            self.assertEqual(result.returncode, 2, name)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            self.assertIn(f"{name}.json", result.stderr)
            self.assertFalse(file.with_suffix(".html").exists())
        self.assertEqual(program.run("report", self.path / "none.json").returncode, 2)

    # -- more than one process

    def mpirun(self, ranks, *arguments):
        command = ["mpirun", "-n", str(ranks), "--oversubscribe", "--allow-run-as-root", program.PROGRAM]
        environment = dict(os.environ, OMPI_MCA_plm_rsh_agent="", OMPI_MCA_btl_base_warn_component_unused="0")
        return command + [str(a) for a in arguments], environment

    def needs_mpi(self):
        linked = subprocess.run(["ldd", program.PROGRAM], capture_output=True, text=True, check=False).stdout
        if shutil.which("mpirun") is None or "libmpi" not in linked:
            self.skipTest("built without MPI, or no mpirun here")

    def answer(self, path):
        numbers = json.loads(path.read_text())
        numbers.pop("seconds")  # what it took is no part of the answer
        return numbers

    def test_two_processes_give_the_answer_of_one(self):
        self.needs_mpi()
        for method in ("staged", "population"):
            one, two = self.path / f"one-{method}.json", self.path / f"two-{method}.json"
            result = program.run("identify", self.case, "--method", method, "--json", one)
            self.assertEqual(result.returncode, 0, result.stderr)
            command, environment = self.mpirun(2, "identify", self.case, "--method", method, "--json", two)
            result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stdout.count("output error:"), 1, "one process speaks")
            self.assertEqual(self.answer(one), self.answer(two), method)

    def test_wrong_input_is_said_once_by_many(self):
        self.needs_mpi()
        command, environment = self.mpirun(2, "identify", self.path / "nowhere")
        result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("feedtwin: "), 1, result.stderr)

    def test_a_killed_process_is_an_error_and_no_hang(self):
        self.needs_mpi()
        out = self.path / "killed.json"
        command, environment = self.mpirun(2, "identify", self.case, "--method", "population", "--json", out)
        run = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            children = []
            end = time.monotonic() + 20.0
            while len(children) < 2 and time.monotonic() < end and run.poll() is None:
                found = " ".join(p.read_text() for p in pathlib.Path(f"/proc/{run.pid}/task").glob("*/children")).split()
                name = pathlib.Path(program.PROGRAM).name
                children = [int(c) for c in found if name == pathlib.Path(f"/proc/{c}/comm").read_text().strip()]
                time.sleep(0.01)
            self.assertEqual(len(children), 2, "both processes run")
            # its first remark comes when the processes have found each other: one that dies while they are still looking is
            # mpirun's to notice, which under load it did not in 60 s, once
            self.assertTrue(select.select([run.stderr], [], [], 20.0)[0], "the processes work together")
            os.kill(children[1], signal.SIGKILL)
            run.communicate(timeout=60)
            self.assertNotEqual(run.returncode, 0)
            self.assertFalse(out.exists(), "nothing is written")
        finally:
            if run.poll() is None:
                run.kill()
                run.communicate()


if __name__ == "__main__":
    unittest.main()
