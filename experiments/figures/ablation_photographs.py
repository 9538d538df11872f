#!/usr/bin/python3
"""What ingredients of the model change of drapes of fabrics fitted to photographs: a row an
ingredient, a dot a picture.

    /usr/bin/python3 ablation_photographs.py ABLATION.json --out DIR/photographs    writes .png and .pdf"""
import numpy as np

import ablation
import study
import style

WIDTH, LEFT, LABEL, TOP, ROW, GAP = 182, 6, 46, 25, 4.6, 6
LEAST = 0.02  # points and mm: changes below are drawn there


def page(result):
    result = result["photographs"]
    pictures = [picture for picture in result["fabrics"] if picture["status"] == "converged"]
    rows = result["ingredients"]
    figure = style.Page(WIDTH, TOP + ROW * len(rows) + 13)
    head(figure, len(result["fabrics"]), pictures)
    for row, ingredient in enumerate(rows):
        figure.text(LEFT, TOP + ROW * (row + 0.5), f"{ingredient['label']} ({ingredient['followed']})",
                    va="center")
    cells = [c for c in result["cells"] if c.get("followed") and c.get("change") is not None]
    strips = (("|change| of drape coefficient, points", lambda c: max(abs(ablation.change(c)), LEAST)),
              ("outline rms, mm", lambda c: max(ablation.rms(c), LEAST)),
              ("change of distance from photograph, mm", lambda c: 1e3 * c["miss_change"]))
    width = (WIDTH - LABEL - LEFT - 2 * GAP) / 3
    for i, (title, value) in enumerate(strips):
        axes = figure.axes(LABEL + i * (width + GAP), TOP, width, ROW * len(rows))
        axes.set(ylim=(len(rows), 0), yticks=[])
        axes.set_xlabel(title, fontsize=6.5)
        for row, ingredient in enumerate(rows):
            ablation.dots(axes, row, [value(c) for c in cells
                                      if c["ingredient"] == ingredient["name"]])
        if i < 2:
            axes.set_xscale("log")
            axes.set_xlim(0.8 * LEAST, max(axes.get_xlim()[1], 10))
            axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
            axes.minorticks_off()
        else:
            axes.axvline(0, color=style.FAINT, linewidth=0.6, zorder=0)
        for side in ("top", "right", "left"):
            axes.spines[side].set_visible(False)
    return figure


def head(figure, count, pictures):
    figure.text(LEFT, 4, "What each ingredient changes of drapes fitted to photographs", fontsize=11,
                weight="bold")
    coefficients = [picture["drape_coefficient_percent"] for picture in pictures] or [0]
    miss = [picture["miss_mm"] for picture in pictures] or [0]
    figure.text(LEFT, 10.5,
                f"Pictures: {count}, draped: {len(pictures)}, with drape coefficients from "
                f"{min(coefficients):.0f} to {max(coefficients):.0f} per cent. A dot is a picture, a "
                "bar the median.\nIn brackets: how many drapes could be followed; the others, whose "
                "branch was lost, are left out. The unchanged drapes miss\ntheir photographs by "
                f"{np.median(miss):.1f} mm (rms, median).")


if __name__ == "__main__":
    study.draw("ablation", __doc__, page)
