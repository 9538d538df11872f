#!/usr/bin/python3
"""Outline and parameter error of fits against CPU time, a line a method.

    /usr/bin/python3 estimation_precision.py curves.json --out DIR/estimation_precision

writes .png and .pdf"""
import numpy as np
from matplotlib.ticker import LogLocator, NullLocator

import study
import style

PANELS = {  # error -> title, lowest value drawn
    "outline_mm": ("Outline, rms in mm", 1e-6),
    "bending_error": ("Worst bending stiffness, relative", 1e-7),
    "shear_error": ("Shear stiffness, relative", 1e-7),
}
LOOK = {  # solid: exact derivatives, dashed: differences, dotted: none
    "levenberg_marquardt": (style.ESTIMATE, (None, None), 1.8),
    "bfgs": ("#D55E00", (None, None), 1.4),
    "levenberg_marquardt_differences": (style.ESTIMATE, (4, 1.5), 1),
    "bfgs_differences": ("#D55E00", (4, 1.5), 1),
    "bobyqa": ("#009E73", (1, 1.2), 1),
    "nelder_mead": ("#222222", (1, 1.2), 1),
}
LEFT, TOP, WIDTH, HEIGHT, STEP = 13, 25, 50, 46, 58


def page(chart):
    curves = {name: drawn for name, drawn in chart["curves"].items()
              if any(value is not None for curve in drawn for value in curve["median"])}
    names = curves["outline_mm"]
    legend_rows = -(-len(names) // 3)
    figure = style.Page(LEFT + STEP * 3, TOP + HEIGHT + 11 + 4.5 * legend_rows)
    figure.text(6, 4, "Error of a fit against its CPU time", fontsize=11, weight="bold")
    figure.text(6, 10.5, f"Best fit so far; median and middle half of {chart['fits']} fits of "
                f"{chart['fabrics']} fabrics, {chart['vertices']} vertices, exact outlines. All "
                "start on the target's own branch\nfrom the same parameters: only the optimiser "
                "differs. A fit that has ended keeps its last error.")
    budget = chart["budget_cpu_seconds"]
    for column, (error, drawn) in enumerate(curves.items()):
        title, floor = PANELS[error]
        axes = figure.axes(LEFT + STEP * column, TOP, WIDTH, HEIGHT)
        for curve in drawn:
            draw(axes, curve, floor, budget)
        axes.set(xscale="log", yscale="log", xlabel="CPU time, s", xlim=(1e-2, budget * 1.3))
        axes.yaxis.set_major_locator(LogLocator(numticks=8))
        axes.yaxis.set_minor_locator(NullLocator())
        axes.set_title(title, fontsize=7)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    legend(figure, names, TOP + HEIGHT + 9)
    return figure


def line(method):
    colour, dashes, width = LOOK[method]
    return dict(color=colour, dashes=dashes, linewidth=width)


def draw(axes, curve, floor, budget):
    time, middle, low, high = (
        np.array([np.nan if value is None else value for value in curve[name]], dtype=float)
        for name in ("cpu_seconds", "median", "low", "high"))
    time, middle, low, high = (np.append(values, last) for values, last in
                               ((time, budget), (middle, middle[-1]), (low, low[-1]),
                                (high, high[-1])))
    look = line(curve["method"])
    axes.plot(time, np.maximum(middle, floor), **look)
    axes.fill_between(time, np.maximum(low, floor), np.maximum(high, floor), color=look["color"],
                      alpha=0.1, linewidth=0)


def legend(figure, curves, top):
    for i, curve in enumerate(curves):
        left, height = 8 + (i % 3) * 58, top + 4.5 * (i // 3)
        axes = figure.axes(left, height, 8, 4)
        axes.axis("off")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.plot([0, 1], [0.5, 0.5], **line(curve["method"]))
        figure.text(left + 9, height + 2, curve["label"], va="center")


if __name__ == "__main__":
    study.draw("estimation_precision", __doc__, page)
