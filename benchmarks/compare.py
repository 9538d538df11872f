#!/usr/bin/python3
"""Compares two JSON files of the benchmark program, benchmark by benchmark.

    benchmarks/compare.py OLD.json NEW.json [--threshold 1.2] [--filter REGEX]

Compared is CPU time: its median over repetitions (--benchmark_repetitions). A benchmark is slower
when NEW/OLD is above the threshold and the difference is more than twice its standard deviation,
which is taken from the repetitions, or from the aggregates where only those were kept; a single
run has no known spread, so the threshold alone decides. Exit 1 when something is slower or fails
that did not, 2 when a file cannot be read or nothing is in both, else 0."""

import argparse
import json
import math
import re
import statistics
import sys
from dataclasses import dataclass

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


@dataclass
class Timing:
    median: float  # seconds of CPU; NaN where the benchmark failed
    deviation: float  # of the median, estimated; NaN where there was a single run

    @property
    def failed(self):
        return math.isnan(self.median)


def read(path):
    """name -> Timing. Exits with code 2 and one line where that is impossible."""
    try:
        with open(path, encoding="utf-8") as file:
            entries = json.load(file)["benchmarks"]
        return timings(entries)
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        reason = f"no {error}" if isinstance(error, KeyError) else error
        print(f"{path}: cannot be read as results of benchmarks: {reason}", file=sys.stderr)
        sys.exit(2)


def timings(entries):
    runs, aggregates, failed = {}, {}, set()
    for entry in entries:
        name = entry.get("run_name", entry["name"])
        if entry.get("error_occurred"):
            failed.add(name)
        elif entry.get("run_type") == "aggregate":
            if entry["aggregate_name"] == "cv":  # a ratio, not a time
                continue
            aggregates.setdefault(name, {"repetitions": entry["repetitions"]})[
                entry["aggregate_name"]] = seconds(entry)
        else:
            runs.setdefault(name, []).append(seconds(entry))
    found = {name: of_runs(values) for name, values in runs.items()}
    for name, values in aggregates.items():
        if name not in found:
            found[name] = Timing(values["median"],
                                 of_median(values["stddev"], values["repetitions"]))
    for name in failed:
        found[name] = Timing(math.nan, math.nan)
    return found


def seconds(entry):
    return float(entry["cpu_time"]) * SECONDS[entry["time_unit"]]


def of_runs(values):
    if len(values) < 2:
        return Timing(values[0], math.nan)
    return Timing(statistics.median(values), of_median(statistics.stdev(values), len(values)))


def of_median(deviation, count):
    """Standard deviation of the median of `count` runs (normal; 1.25 times that of the mean)."""
    return 1.25 * deviation / math.sqrt(count)


def verdict(old, new, threshold):
    """slower, faster, same, noisy (beyond the threshold, within the noise), failed or mended."""
    if new.failed:
        return "same" if old.failed else "failed"
    if old.failed:
        return "mended"
    ratio = new.median / old.median
    if 1 / threshold <= ratio <= threshold:
        return "same"
    deviations = [t.deviation for t in (old, new) if not math.isnan(t.deviation)]
    if abs(new.median - old.median) <= 2 * math.hypot(*deviations):
        return "noisy"
    return "slower" if ratio > threshold else "faster"


def row(name, old, new, word):
    def cell(timing):
        if timing.failed:
            return "failed"
        spread = ("" if math.isnan(timing.deviation)
                  else f" ±{100 * timing.deviation / timing.median:.1f} %")
        return f"{1e3 * timing.median:.4g} ms{spread}"

    ratio = "" if old.failed or new.failed else f"{new.median / old.median:.3f}"
    return f"{name:<52} {cell(old):>20} {cell(new):>20} {ratio:>8}  {word}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", metavar="OLD.json")
    parser.add_argument("new", metavar="NEW.json")
    parser.add_argument("--threshold", type=float, default=1.2,
                        help="ratio above which a benchmark is slower (%(default)s)")
    parser.add_argument("--filter", default="", help="regular expression on the names")
    arguments = parser.parse_args()
    if not arguments.threshold >= 1:
        parser.error("--threshold must be at least 1")
    try:
        wanted = re.compile(arguments.filter)
    except re.error as error:
        parser.error(f"--filter {arguments.filter}: {error}")
    old, new = read(arguments.old), read(arguments.new)
    both = [name for name in old if name in new and wanted.search(name)]
    if not both:
        print("no benchmark is in both files", file=sys.stderr)
        return 2
    print(f"{'CPU per iteration':<52} {'old':>20} {'new':>20} {'new/old':>8}")
    verdicts = []
    for name in both:
        verdicts.append(verdict(old[name], new[name], arguments.threshold))
        print(row(name, old[name], new[name], verdicts[-1]))
    for title, one, other in (("old", old, new), ("new", new, old)):
        for name in one:
            if name not in other and wanted.search(name):
                print(f"{name:<52} only in {title}")
    ratios = [new[name].median / old[name].median for name in both
              if not old[name].failed and not new[name].failed]
    if ratios:
        mean = math.exp(statistics.fmean(map(math.log, ratios)))
        print(f"geometric mean of {len(ratios)} ratios: {mean:.3f}; " +
              ", ".join(f"{verdicts.count(word)} {word}" for word in dict.fromkeys(verdicts)))
    return 1 if {"slower", "failed"} & set(verdicts) else 0


if __name__ == "__main__":
    sys.exit(main())
