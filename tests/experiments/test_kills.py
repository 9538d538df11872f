#!/usr/bin/python3
"""A dataset whose generation is killed (SIGKILL) again and again at random moments ends as the same
file as one that was left alone, and does nothing twice that it had acknowledged.

    /usr/bin/python3 test_kills.py PROGRAM [--kills 8] [--fabrics 12] [--seed 5]

Nine of ten kills fall anywhere, one of ten between the last record and the end of the run.
"""

import argparse
import hashlib
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from same_records import differences  # noqa: E402

CONFIG = """[experiment]
kind = 'dataset'
[mesh]
vertices = 250
[start]
protocol = 'lobes'
[fabric]
bending_threshold = 'radius'
[dataset]
pixels = 32
fabrics = {}
"""


def records(run):
    """Finished records of a run -> what identifies the file of each."""
    return {file.name: file.stat().st_mtime_ns for file in (run / "records").glob("*.h5")}


class Generation:
    def __init__(self, arguments, folder):
        self.program, self.fabrics = arguments.program, arguments.fabrics
        self.folder = folder
        (folder / "d.toml").write_text(CONFIG.format(arguments.fabrics), encoding="ascii")

    def start(self, run):
        return subprocess.Popen(
            [self.program, "run", self.folder / "d.toml", "--threads", "1", "--out", run],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def is_whole(self, run):
        return (run / "results.h5").exists() or len(records(run)) == self.fabrics

    def undisturbed(self, run):
        """Its seconds until the last record and from there on."""
        begin = time.monotonic()
        process = self.start(run)
        while not self.is_whole(run) and process.poll() is None:
            time.sleep(0.002)
        whole = time.monotonic()
        assert process.wait() == 0, "the undisturbed run failed"
        return whole - begin, time.monotonic() - whole

    def killed(self, run, delay, at_the_end):
        """Starts it and kills it after `delay`; whether it had ended before that."""
        process = self.start(run)
        while at_the_end and not self.is_whole(run) and process.poll() is None:
            time.sleep(0.002)
        time.sleep(delay)
        process.kill()
        return process.wait() == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--fabrics", type=int, default=12)
    parser.add_argument("--seed", type=int, default=5)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)

    with tempfile.TemporaryDirectory() as folder:
        generation = Generation(arguments, Path(folder))
        whole, run = Path(folder) / "whole", Path(folder) / "killed"
        work, end = generation.undisturbed(whole)
        anywhere = arguments.kills - arguments.kills // 10
        kills, acknowledged = 0, {}
        for session in range(arguments.kills):
            at_the_end = session >= anywhere
            delay = chance.uniform(0, 0.8 * end if at_the_end else 2 * work / anywhere)
            if generation.killed(run, delay, at_the_end):
                break  # it was faster
            kills += 1
            now = records(run)
            if not (run / "results.h5").exists():
                lost = [name for name in acknowledged if now.get(name) != acknowledged[name]]
                assert not lost, f"after kill {kills} lost or done again: {lost}"
            acknowledged = now
        process = generation.start(run)
        assert process.wait() == 0, "the last session failed"
        print(f"{arguments.fabrics} fabrics, {kills} kills; undisturbed {work + end:.1f} s")
        assert kills >= 0.8 * arguments.kills, "too few kills fell into the run"

        found = differences(whole / "results.h5", run / "results.h5")
        assert not found, "\n".join(found)
        assert (whole / "config.toml").read_bytes() == (run / "config.toml").read_bytes()
        listed = (run / "results.h5.sha256").read_text(encoding="ascii").split()[0]
        assert listed == hashlib.sha256((run / "results.h5").read_bytes()).hexdigest()


if __name__ == "__main__":
    main()
