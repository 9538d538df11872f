#!/usr/bin/python3
"""Error against CPU time of several methods: a row a start and mesh size, a column a fabric.

    /usr/bin/python3 work_precision.py CHART.json --out DIR/chart    writes .png and .pdf"""
import textwrap

import numpy as np
from matplotlib.ticker import LogLocator, NullLocator

import methods
import study
import style

TITLES = {
    "residual": "Largest nodal force over the largest nodal weight",
    "rms_mm": "Distance to the minimum of the method's own basin, rms of the vertices in mm",
    "drape_coefficient_error": "Error of the drape coefficient against that minimum, points",
}
LOWEST = {"residual": 1e-10, "rms_mm": 1e-7, "drape_coefficient_error": 1e-7}
STARTS = {"folded": "from a folded state", "near": "from a drape 10 % stiffer"}
COLUMNS = 118  # of text across the page
LEFT, TOP, WIDTH, HEIGHT, STEP_X, STEP_Y = 13, 30, 50, 38, 56.5, 51


def page(chart):
    panels = chart["panels"]
    rows = sorted({(p["start"], p["vertices"]) for p in panels})
    columns = sorted({p["fabric"] for p in panels})
    curves = panels[0]["curves"]
    legend_rows = -(-len(curves) // 4)
    figure = style.Page(max(LEFT + STEP_X * len(columns), 182),
                        TOP + STEP_Y * len(rows) + 3 + 4.5 * legend_rows)
    figure.text(6, 4, "Error against CPU time", fontsize=11, weight="bold")
    seeds = panels[0]["seeds"]
    spread = f"median and range over {seeds} meshes" if seeds > 1 else "one mesh"
    account = (f"{TITLES[chart['error']]}; {spread}. All methods have the same budget of CPU time. "
               "Full circle: every run converged; open: some run was still on its way when its "
               "budget ended; cross: the others stalled, diverged or ended at a saddle.")
    figure.text(6, 10.5, textwrap.fill(account, COLUMNS))
    floor = LOWEST[chart["error"]]
    for panel in panels:
        row, column = rows.index((panel["start"], panel["vertices"])), \
            columns.index(panel["fabric"])
        axes = figure.axes(LEFT + STEP_X * column, TOP + STEP_Y * row, WIDTH, HEIGHT)
        for curve in panel["curves"]:
            draw(axes, curve, floor)
        axes.set(xscale="log", yscale="log", xlim=(1e-3, panel["budget_cpu_seconds"] * 1.3))
        axes.yaxis.set_major_locator(LogLocator(numticks=6))
        axes.yaxis.set_minor_locator(NullLocator())
        axes.set_title(f"{panel['softness']}, {panel['vertices']} vertices\n"
                       f"{STARTS[panel['start']]}", fontsize=7)
        if row == len(rows) - 1:
            axes.set_xlabel("CPU time, s")
        if axes.get_ylim()[0] < floor:
            axes.set_ylim(bottom=floor)
        axes.axvline(panel["budget_cpu_seconds"], color=style.FAINT, linewidth=0.6)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    legend(figure, curves, TOP + STEP_Y * len(rows))
    return figure


def draw(axes, curve, floor):
    time, middle, low, high = (
        np.array([np.nan if value is None else value for value in curve[name]], dtype=float)
        for name in ("cpu_seconds", "median", "low", "high"))
    look = methods.line(curve["method"])
    axes.plot(time, np.maximum(middle, floor), **look)
    axes.fill_between(time, np.maximum(low, floor), np.maximum(high, floor), color=look["color"],
                      alpha=0.12, linewidth=0)
    marker, face = end(curve["outcomes"])
    axes.plot(time[-1:], np.maximum(middle[-1:], floor), marker, color=look["color"], markersize=2.6,
              markeredgewidth=0.7, markerfacecolor=face or look["color"], zorder=look["zorder"] + 1)


def end(outcomes):
    """Marker and face colour (None: the line's) of a curve's end."""
    if all(outcome == "converged" for outcome in outcomes):
        return "o", None
    return ("o", "white") if "out_of_budget" in outcomes else ("x", None)


def legend(figure, curves, top):
    per_row = 4
    for i, curve in enumerate(curves):
        left = 8 + (i % per_row) * 43
        height = top + 4.5 * (i // per_row)
        axes = figure.axes(left, height, 8, 4)
        axes.axis("off")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.plot([0, 1], [0.5, 0.5], **methods.line(curve["method"]))
        figure.text(left + 9, height + 2, curve["label"], va="center")


if __name__ == "__main__":
    study.draw("work_precision", __doc__, page)
