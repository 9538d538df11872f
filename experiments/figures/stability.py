#!/usr/bin/python3
"""Atlas of where methods converge: a row a method, a map a mesh size, coloured by outcome.

    /usr/bin/python3 stability.py ATLAS.json --out DIR/atlas    writes .png and .pdf"""
from math import log10

from matplotlib.patches import Rectangle

import study
import style

OUTCOMES = {  # outcome -> colour, words
    "converged": ("#0072B2", "converged to a minimum"),
    "saddle": ("#CC79A7", "saddle"),
    "out_of_budget": ("#F0E442", "on its way at the end of the budget"),
    "stalled": ("#E69F00", "stalled"),
    "diverged": ("#222222", "diverged"),
    "not_run": ("#EEEEEE", "not run"),
}
CASES = {"vanishing_bending": "no bending", "ratio_1e8": "ratio 1e8", "needles": "needles",
         "threshold_softening": "softening", "threshold_stiffening": "stiffening",
         "secant": "secant law", "near_snap": "near a snap"}
LABEL, TOP, ROW, GAP = 42, 35, 13, 5
CELL, LEAST_MAP = 4.2, 20  # width of a cell, more where a map would be narrower than its words


def page(atlas):
    cells = atlas["cells"]
    mapped = [c for c in cells if c["case"] == "map"]
    own = [c for c in mapped if not c["time_step"]]
    ratios = sorted({c["membrane_to_bending"] for c in mapped})
    densities = sorted({c["areal_density"] for c in own})
    steps = sorted({c["time_step"] for c in mapped} - {0})
    sizes = sorted({c["vertices"] for c in mapped})
    cases = [name for name in CASES if any(c["case"] == name for c in cells)]
    groups = [(f"{size} vertices", "ratio", "density", [("own", size, r, d) for d in densities
                                                        for r in ratios], len(ratios))
              for size in sizes]
    groups += [(f"{size} vertices", "ratio", "time step",
                [("step", size, r, s) for s in steps for r in ratios], len(ratios))
               for size in (sizes if steps else [])]
    if cases:
        groups.append(("hard cases", "", "", [("case", name) for name in cases], len(cases)))
    cell = max(CELL, LEAST_MAP / min(group[4] for group in groups))
    width = LABEL + sum(GAP + cell * group[4] for group in groups) - GAP + 6
    methods = list(atlas["methods"])
    figure = style.Page(max(width, 180), TOP + ROW * len(methods) + 44)
    head(figure, atlas, ratios, densities, steps)
    look = {key(c): (OUTCOMES[c["outcome"]][0], exponent(c)) for c in cells}
    for row, method in enumerate(methods):
        top = TOP + ROW * row
        figure.text(6, top + ROW / 2 - 1, atlas["methods"][method]["label"], va="center")
        left = LABEL
        for title, across, up, places, columns in groups:
            draw(figure, left, top, cell, columns, [look.get((method, *place)) for place in places])
            if row == 0:
                figure.text(left, top - 5.5, title)
            if row == len(methods) - 1 and across:
                figure.text(left, top + ROW - 1, f"{across} →\n{up} ↑")
            left += GAP + cell * columns
    below = TOP + ROW * len(methods)
    for i, name in enumerate(cases):
        figure.text(width - 6 - cell * (len(cases) - i - 0.5), below - 0.5, CASES[name],
                    rotation=90, ha="center")
    legend(figure, below + 24)
    return figure


def key(cell):
    if cell["case"] != "map":
        return cell["method"], "case", cell["case"]
    step = cell["time_step"]
    return (cell["method"], "step" if step else "own", cell["vertices"],
            cell["membrane_to_bending"], step or cell["areal_density"])


def exponent(cell):
    """Decimal exponent of the smallest residual where the method was stopped, or stopped itself."""
    if cell["outcome"] not in ("stalled", "out_of_budget"):
        return ""
    return f"{round(log10(cell['smallest_residual']))}".replace("-", "−")


def head(figure, atlas, ratios, densities, steps):
    def listed(values):
        return ", ".join(f"{value:g}" for value in values)
    figure.text(6, 4, "Where methods converge", fontsize=11, weight="bold")
    words = (f"Every cell is one drape from a folded start; every method has "
             f"{atlas['cpu_seconds']:g} s of CPU at 1000 vertices, in proportion to the mesh.\n"
             f"Across: membrane over bending stiffness {listed(ratios)}. "
             f"Up: areal density {listed(densities)} kg/m²")
    figure.text(6, 10.5, words + (f",\nor time step {listed(steps)} s at the middle density. "
                                  if steps else ".\n") +
                "Numbers: decimal exponent of the smallest residual.")


def draw(figure, left, top, cell, columns, looks):
    """`looks` (colour and number) row by row from below; cells without one are left out."""
    if not any(looks):
        return
    rows = len(looks) // columns
    axes = figure.axes(left, top, cell * columns, ROW - 2)
    axes.set(xlim=(0, columns), ylim=(0, rows))
    axes.axis("off")
    for i, look in enumerate(looks):
        if look is None:
            continue
        column, row = i % columns, i // columns
        axes.add_patch(Rectangle((column, row), 1, 1, facecolor=look[0], edgecolor="white",
                                 linewidth=0.5))
        axes.text(column + 0.5, row + 0.47, look[1], ha="center", va="center", fontsize=6)


def legend(figure, top):
    for i, (colour, words) in enumerate(OUTCOMES.values()):
        left, height = 6 + 58 * (i % 3), top + 5 * (i // 3)
        axes = figure.axes(left, height, 4, 3.4)
        axes.axis("off")
        axes.add_patch(Rectangle((0, 0), 1, 1, facecolor=colour))
        figure.text(left + 5.5, height + 1.7, words, va="center")


if __name__ == "__main__":
    study.draw("stability", __doc__, page)
