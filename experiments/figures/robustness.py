#!/usr/bin/python3
"""Work of each cold drape, in factorisation-equivalents, against the fabric's bending length.

    /usr/bin/python3 robustness.py DIR/solves.csv --out DIR/units    writes units.png and units.pdf
"""

import argparse
import csv
import sys

import numpy as np

import style

COLOURS = {"measured": style.ESTIMATE, "wide": style.START}
MARKERS = {"measured": "o", "wide": "^"}
LABELS = {"measured": "measured distribution", "wide": "wide box"}
NEEDED = ["distribution", "size", "bending_length_m", "cpu_seconds", "unit_cpu_seconds", "failure"]


def read(path):
    """The rows of a solves.csv. Exits with code 2 and one line where that is impossible."""
    try:
        with open(path, newline="") as file:
            table = csv.DictReader(file)
            missing = [name for name in NEEDED if name not in (table.fieldnames or [])]
            if missing:
                raise ValueError(f"no column {missing[0]}")
            rows = list(table)
        if not rows:
            raise ValueError("no rows")
        for row in rows:
            row["length"] = 1e3 * number(row["bending_length_m"])
            row["units"] = number(row["cpu_seconds"]) / number(row["unit_cpu_seconds"])
        return rows
    except (OSError, ValueError) as error:
        print(f"{path}: cannot be read as a table of solves: {error}", file=sys.stderr)
        sys.exit(2)


def number(text):
    return float(text) if text else float("nan")


def chart(rows):
    """The page: one panel a mesh size, failures crossed out."""
    sizes = sorted({int(row["size"]) for row in rows})
    width = 86
    page = style.Page(8 + width * len(sizes), 88)
    page.text(4, 3, "Work of a cold drape", fontsize=9, weight="bold")
    units = np.array([row["units"] for row in rows])
    units = units[np.isfinite(units)]
    top, bottom = (1.5 * units.max(), 0.7 * units.min()) if len(units) else (100, 1)
    for i, size in enumerate(sizes):
        axes = page.axes(14 + i * width, 25, width - 14, 51)
        panel(axes, [row for row in rows if int(row["size"]) == size], bottom, top)
        page.text(14 + i * width, 8.5, f"{size} vertices", fontsize=7)
    return page


def panel(axes, rows, bottom, top):
    for name, colour in COLOURS.items():
        some = [row for row in rows if row["distribution"] == name]
        failed = [row for row in some if row["failure"]]
        good = [row for row in some if not row["failure"]]
        if some:
            median = np.nanmedian([row["units"] for row in good]) if good else float("nan")
            label = f"{LABELS[name]}: {len(good)} of {len(some)}, median {style.number(median)}"
            axes.plot([row["length"] for row in good], [row["units"] for row in good],
                      MARKERS[name], color=colour, markersize=2.8, alpha=0.7, markeredgewidth=0, label=label)
        if failed:
            # A solve that threw has no count of work: its cross stands on the lower edge.
            heights = [row["units"] if np.isfinite(row["units"]) else bottom for row in failed]
            axes.plot([row["length"] for row in failed], heights, "x", color=style.WARNING,
                      markersize=5, clip_on=False, label=f"failed ({LABELS[name]}): {len(failed)}")
    axes.set(xscale="log", yscale="log", ylim=(bottom, top),
             xlabel="bending length $(B / \\varrho g)^{1/3}$ [mm]",
             ylabel="factorisation-equivalents")
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        ticks = [digit * 10.0**power for power in range(-3, 7) for digit in (1, 2, 5)]
        axis.set_ticks([tick for tick in ticks if low <= tick <= high])
        axis.set_ticks([], minor=True)
        axis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(fontsize=6, frameon=False, loc="lower left", bbox_to_anchor=(-0.03, 1),
                borderaxespad=0, handletextpad=0.3)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("solves", help="solves.csv of a robustness run")
    parser.add_argument("--out", required=True, help="files without their suffix")
    arguments = parser.parse_args()
    for file in chart(read(arguments.solves)).save(arguments.out):
        print(file)


if __name__ == "__main__":
    main()
