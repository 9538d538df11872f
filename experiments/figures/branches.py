#!/usr/bin/python3
"""Bifurcation diagram: drape coefficient against bending stiffness along the branches of
kind = "branches", swept up and down, with the snaps between them.

    /usr/bin/python3 branches.py RESULTS.h5 --out DIR/branches     writes branches.png and branches.pdf

The branches themselves are read from branches.json beside the results.
"""

import argparse
import json
import sys
from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

import results as records
import style

WIDTH, HEIGHT = 180, 130  # mm
PLOT = (16, 16, 158, 100)  # left, top, width, height [mm]
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222"]
LARGE = 0.5  # jumps of the drape coefficient [points] that get a marker of their own
INSETS = 6
INSET = 15  # mm


def read_branches(results_file):
    file = Path(results_file).parent / "branches.json"
    try:
        return json.loads(file.read_text())
    except (OSError, ValueError) as error:
        print(f"{file}: cannot be read: {error}", file=sys.stderr)
        sys.exit(2)


def diagram(results, summary):
    page = style.Page(WIDTH, HEIGHT)
    branches = [branch for branch in summary["branches"] if branch["points"]]
    page.text(PLOT[0], 4, "Branches of drapes as the bending stiffness grows and falls",
              fontsize=11, weight="bold")
    axes = page.axes(*PLOT)
    for branch, colour in zip(branches, COLOURS * len(branches)):
        draw_branch(axes, branch, colour)
    axes.set_xscale("log")
    axes.set_xlabel("bending stiffness $k_b$ over that of the fabric")
    axes.set_ylabel("drape coefficient [%]")
    axes.margins(x=0.03, y=0.08)
    ticks = [t for t in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
             if axes.get_xlim()[0] <= t <= axes.get_xlim()[1]]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()
    legend(axes, branches)
    insets(page, axes, results, branches)
    snaps = summary["snaps"]
    large = sum(abs(snap["drape_coefficient_percent_jump"]) >= LARGE for snap in snaps)
    page.text(PLOT[0], HEIGHT - 5,
              f"{len(snaps)} snaps, {large} of them by {LARGE:g} points or more. Small numbers: "
              "nodes. Insets: outlines, weft to the right. "
              f"Drape, commit {results.git_commit[:12]}", fontsize=6, color="#666666")
    return page


def draw_branch(axes, branch, colour):
    snaps = {snap["segment"]: snap for snap in branch["snaps"]}
    nodes = None
    for (segment, sweep), points in groupby(branch["points"],
                                            lambda point: (point["segment"], point["sweep"])):
        points = list(points)
        x = [point["factor"] for point in points]
        y = [point["drape_coefficient_percent"] for point in points]
        snap = snaps.get(segment)
        if snap and snap["sweep"] == sweep:
            x.append(snap["factor"])
            y.append(snap["drape_coefficient_percent_before"])
            draw_snap(axes, snap, colour)
        line = {"up": "-", "down": (0, (3, 1.2))}[sweep]
        axes.plot(x, y, color=colour, linestyle=line, linewidth=0.9)
        for point in points:
            if point["node_count"] != nodes and sweep == "up":
                nodes = point["node_count"]
                axes.annotate(str(nodes), (point["factor"], point["drape_coefficient_percent"]),
                              xytext=(-1.5, 2.5), textcoords="offset points", fontsize=6,
                              color=colour, ha="right")


def draw_snap(axes, snap, colour):
    factor, before = snap["factor"], snap["drape_coefficient_percent_before"]
    after = snap["drape_coefficient_percent_after"]
    if abs(after - before) < LARGE:
        axes.plot([factor], [before], marker="|", markersize=3, markeredgewidth=0.5, color=colour)
        return
    axes.annotate("", (factor, after), (factor, before),
                  arrowprops=dict(arrowstyle="-|>", color=colour, linewidth=0.7, mutation_scale=5,
                                  shrinkA=0, shrinkB=0))
    axes.plot([factor], [before], marker="o", markersize=2.6, color=colour, markeredgewidth=0)


def legend(axes, branches):
    handles = [Line2D([], [], color=colour, linewidth=1.2) for _, colour in zip(branches, COLOURS)]
    labels = [f"start at the softest fabric: {branch['start']}" for branch in branches]
    handles += [Line2D([], [], color="#666666", linestyle="-"),
                Line2D([], [], color="#666666", linestyle=(0, (3, 1.2))),
                Line2D([], [], color="#666666", marker="o", markersize=3, linestyle=""),
                Line2D([], [], color="#666666", marker="|", markersize=4, linestyle="")]
    labels += ["stiffness grows", "stiffness falls", "snap (arrow: where it lands)",
               f"snap below {LARGE:g} points"]
    axes.legend(handles, labels, loc="lower right", frameon=False, fontsize=6)


def insets(page, axes, results, branches):
    """Outlines of a few points, in a row at the top of the plot with a line to each."""
    chosen = []
    for i in range(INSETS):
        branch = branches[i % len(branches)]
        up = [point for point in branch["points"] if point["sweep"] == "up"]
        chosen.append((up[int((i + 0.4) / INSETS * (len(up) - 1))], COLOURS[i % len(branches)]))
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.24 * (high - low))
    axes.set_yticks([tick for tick in axes.get_yticks() if low <= tick <= min(high, 100)])
    chosen.sort(key=lambda item: item[0]["factor"])
    for i, (point, colour) in enumerate(chosen):
        left = PLOT[0] + 2 + i * (PLOT[2] - INSET - 4) / (INSETS - 1)
        inset = page.axes(left, PLOT[1] + 1.5, INSET, INSET)
        draw_outline(inset, results, results.records[point["record"]].profile, colour)
        end = axes.transAxes.inverted().transform(axes.transData.transform(
            (point["factor"], point["drape_coefficient_percent"])))
        start = ((left + INSET / 2 - PLOT[0]) / PLOT[2], 1 - (INSET + 1.5) / PLOT[3])
        axes.plot([start[0], end[0]], [start[1], end[1]], transform=axes.transAxes,
                  color=style.FAINT, linewidth=0.4, zorder=0)


def draw_outline(axes, results, profile, colour):
    angle = np.radians(np.arange(len(profile) + 1) * 360 / len(profile))
    radius = 1e3 * np.append(profile, profile[0])
    support = 1e3 * results.support_radius
    axes.plot(support * np.cos(angle), support * np.sin(angle), color=style.FAINT, linewidth=0.4)
    axes.plot(radius * np.cos(angle), radius * np.sin(angle), color=colour, linewidth=0.8)
    half = 1.04e3 * results.specimen_radius
    axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal")
    axes.axis("off")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", help="a results.h5 of kind branches")
    parser.add_argument("--out", required=True, help="path of the figure without its suffix")
    arguments = parser.parse_args()
    page = diagram(records.read(arguments.results), read_branches(arguments.results))
    for file in page.save(arguments.out):
        print(file)


if __name__ == "__main__":
    main()
