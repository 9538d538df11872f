#!/usr/bin/python3
"""benchmarks/compare.py on made-up results: verdicts, spread, exit codes."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

COMPARE = Path(__file__).resolve().parents[2] / "benchmarks" / "compare.py"


def run(name, *milliseconds, unit="ms"):
    scale = {"ms": 1, "us": 1e3}[unit]
    return [{"name": name, "run_name": name, "run_type": "iteration", "cpu_time": scale * value,
             "time_unit": unit} for value in milliseconds]


def aggregates(name, median, deviation, repetitions):
    values = {"mean": median, "median": median, "stddev": deviation, "cv": deviation / median}
    return [{"name": f"{name}_{kind}", "run_name": name, "run_type": "aggregate",
             "aggregate_name": kind, "repetitions": repetitions, "cpu_time": value,
             "time_unit": "ms"} for kind, value in values.items()]


def error(name):
    return [{"name": name, "run_name": name, "run_type": "iteration", "error_occurred": True,
             "error_message": "the drape did not converge", "cpu_time": 0, "time_unit": "ms"}]


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, entries):
        path = self.folder / name
        path.write_text(json.dumps({"context": {}, "benchmarks": entries}))
        return path

    def compare(self, old, new, *options):
        return subprocess.run(
            [sys.executable, "-B", COMPARE, self.write("old.json", old),
             self.write("new.json", new), *options], capture_output=True, text=True)

    def expect(self, old, new, code, word, *options):
        done = self.compare(old, new, *options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        rows = [line for line in done.stdout.splitlines() if line.startswith("cold/2000")]
        self.assertEqual(len(rows), 1, done.stdout)
        self.assertTrue(rows[0].endswith(word), rows[0])

    def test_a_single_run_is_judged_by_the_threshold(self):
        self.expect(run("cold/2000", 10), run("cold/2000", 11.9), 0, "same")
        self.expect(run("cold/2000", 10), run("cold/2000", 12.1), 1, "slower")
        self.expect(run("cold/2000", 10), run("cold/2000", 8.2), 0, "faster")
        self.expect(run("cold/2000", 10), run("cold/2000", 12.1), 0, "same", "--threshold", "1.25")
        self.expect(run("cold/2000", 10), run("cold/2000", 11.9), 1, "slower", "--threshold", "1.1")

    def test_times_in_different_units_compare(self):
        self.expect(run("cold/2000", 10), run("cold/2000", 10.1, unit="us"), 0, "same")
        self.expect(run("cold/2000", 10, unit="us"), run("cold/2000", 13), 1, "slower")

    def test_what_the_spread_explains_is_no_verdict(self):
        steady, noisy = (10, 10.1, 9.9, 10, 10.05), (10, 22, 13, 30, 11)
        self.expect(run("cold/2000", *steady), run("cold/2000", *noisy), 0, "noisy")
        self.expect(run("cold/2000", *noisy), run("cold/2000", *steady), 0, "noisy")
        self.expect(run("cold/2000", *steady), run("cold/2000", 13, 13.2, 12.9, 13), 1, "slower")
        self.expect(run("cold/2000", *steady), run("cold/2000", 10, 10, 40, 10, 10), 0, "same")

    def test_aggregates_alone_suffice(self):
        self.expect(aggregates("cold/2000", 10, 0.2, 5), aggregates("cold/2000", 13, 0.2, 5), 1,
                    "slower")
        self.expect(aggregates("cold/2000", 10, 4, 5), aggregates("cold/2000", 13, 4, 5), 0,
                    "noisy")
        # where the runs are there as well, they are what counts
        self.expect(run("cold/2000", 10, 10.2) + aggregates("cold/2000", 50, 1, 2),
                    run("cold/2000", 10, 10.1), 0, "same")

    def test_a_new_failure_counts_an_old_one_does_not(self):
        self.expect(run("cold/2000", 10), error("cold/2000"), 1, "failed")
        self.expect(error("cold/2000"), run("cold/2000", 10), 0, "mended")
        self.expect(error("cold/2000"), error("cold/2000"), 0, "same")

    def test_what_is_in_one_file_only_is_listed(self):
        done = self.compare(run("a", 1) + run("b", 1), run("b", 1) + run("c", 1))
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"(?m)^a +only in old$")
        self.assertRegex(done.stdout, r"(?m)^c +only in new$")
        self.assertEqual(self.compare(run("a", 1), run("b", 1)).returncode, 2)

    def test_a_filter_leaves_out_the_others(self):
        slow = run("cold/2000", 30) + run("warm", 1)
        self.assertEqual(self.compare(run("cold/2000", 10) + run("warm", 1), slow).returncode, 1)
        self.assertEqual(self.compare(run("cold/2000", 10) + run("warm", 1), slow, "--filter",
                                      "^warm").returncode, 0)

    def test_unreadable_input_is_one_line_and_exit_2(self):
        good = self.write("good.json", run("a", 1))
        contents = ["", "no json", "[]", "{}", '{"benchmarks": 3}', '{"benchmarks": [{}]}',
                    '{"benchmarks": [{"name": "a", "cpu_time": 1, "time_unit": "h"}]}']
        for content in contents:
            bad = self.folder / "bad.json"
            bad.write_text(content)
            for pair in ((good, bad), (bad, good)):
                done = subprocess.run([sys.executable, "-B", COMPARE, *pair], capture_output=True,
                                      text=True)
                self.assertEqual(done.returncode, 2, content)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(str(bad), done.stderr)
        self.assertEqual(subprocess.run([sys.executable, "-B", COMPARE, good, self.folder / "none"],
                                        capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
