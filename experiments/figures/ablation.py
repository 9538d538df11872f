#!/usr/bin/python3
"""What ingredients of the model change of a drape: a row an ingredient, a column a fabric.

    /usr/bin/python3 ablation.py ABLATION.json --out DIR/ablation    writes .png and .pdf"""
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle

import study
import style

WIDTH, LABEL, TOP, ROW, GAP = 182, 40, 36, 6.4, 4
LEAST_COST = 22  # width of the panel of costs, which takes what the cells leave
LARGEST_CELL, LEAST_MATRIX = 12, 26  # the title of a matrix needs that width
POINTS, MILLIMETRES = (0.02, 10), (0.02, 10)  # ends of the colours
RULES = (("contact_rule", "contact = auto"), ("resolution_rule", "vertices = auto"))


def page(result):
    fabrics = [fabric for fabric in result["fabrics"] if fabric["status"] == "converged"]
    rows = result["ingredients"]
    columns = max(len(fabrics), 1)
    cell = max(LEAST_MATRIX / columns, min(
        LARGEST_CELL, (WIDTH - LABEL - 2 * GAP - LEAST_COST - 6) / 2 / columns))
    height = ROW * len(rows)
    checked = [(rule, title) for rule, title in RULES if result[rule]["checked"]]
    below = TOP + height + 11  # the scale of the costs
    figure = style.Page(WIDTH, below + (69 if checked else 0))
    head(figure, result)
    cells = {(c["ingredient"], c["fabric"]): c for c in result["cells"]}
    width = cell * columns
    lefts = [LABEL, LABEL + width + GAP]
    titles = ("change of drape\ncoefficient, points", "outline rms, mm,\nand nodes")
    for left, title, words, value, ends in zip(
            lefts, titles, (change_words, rms_words), (change, rms), (POINTS, MILLIMETRES)):
        axes = matrix(figure, left, width, height, columns, len(rows))
        figure.text(left, TOP - 10, title)
        for column, fabric in enumerate(fabrics):
            axes.text(column + 0.5, -0.2, coefficient(fabric), ha="center", va="bottom", fontsize=6)
            for row, ingredient in enumerate(rows):
                paint(axes, column, row, cells.get((ingredient["name"], fabric["name"])), words, value, ends)
    for row, ingredient in enumerate(rows):
        figure.text(6, TOP + ROW * (row + 0.5), ingredient["label"], va="center")
    cost(figure, lefts[1] + width + GAP, height, rows, result["cells"])
    for i, (rule, title) in enumerate(checked):
        check(figure, LABEL / 2 + 6 + 88 * i, below + 9, result, rule, title)
    return figure


def dots(axes, row, values):
    axes.plot(values, [row + 0.5] * len(values), "o", color=style.FAINT, markersize=2.4)
    if values:
        axes.plot([np.median(values)] * 2, [row + 0.2, row + 0.8], color=style.ESTIMATE,
                  linewidth=1.6)


def coefficient(fabric):
    return f"{fabric['drape_coefficient_percent']:.0f}"


def head(figure, result):
    figure.text(6, 4, "What each ingredient changes of a drape, and what it costs", fontsize=11,
                weight="bold")
    figure.text(6, 10.5,
                f"{len(result['cells'])} changes on {result['vertices']} vertices. Columns: the drape "
                "coefficient of the unchanged drape, per cent. Every changed drape is\nfollowed from "
                "the unchanged one. Hatched: the branch was lost, the numbers are not the "
                "ingredient's alone. Empty: no drape was\nreached. Quotation mark: snaps on the way, "
                "whose jumps are left out of the change of the coefficient. In brackets: change of\n"
                "the number of nodes.")


def matrix(figure, left, width, height, columns, rows):
    axes = figure.axes(left, TOP, width, height)
    axes.set(xlim=(0, columns), ylim=(rows, 0))
    axes.axis("off")
    return axes


def change(cell):
    return cell["change"] - cell.get("snap_change", 0)


def change_words(cell):
    if abs(change(cell)) < 0.005:
        return "0.00" + "'" * (cell["snaps"] > 0)
    digits = 2 if abs(change(cell)) < 0.995 else 1 if abs(change(cell)) < 9.95 else 0
    return signed(change(cell), f".{digits}f") + "'" * (cell["snaps"] > 0)


def rms(cell):
    return 1e3 * cell["outline_rms"]


def rms_words(cell):
    nodes = cell["node_change"]
    text = f"{rms(cell):.2f}" if rms(cell) < 0.995 else f"{rms(cell):.1f}"
    return text + (f"\n({signed(nodes, 'd')})" if nodes else "")


def signed(value, form):
    return f"{value:+{form}}".replace("-", "−")


def paint(axes, column, row, cell, words, value, ends):
    known = cell is not None and cell.get("change") is not None
    colours = style.plt.get_cmap("YlOrRd")
    shade = LogNorm(*ends, clip=True)(max(abs(value(cell)), ends[0])) if known else None
    axes.add_patch(Rectangle((column, row), 1, 1, edgecolor="white", linewidth=0.6,
                             facecolor=colours(0.8 * float(shade)) if known else "white",
                             hatch=None if known and cell["followed"] else "////" if known else None))
    if known:
        axes.text(column + 0.5, row + 0.52, words(cell), ha="center", va="center", fontsize=6,
                  linespacing=0.9, bbox=None if cell["followed"] else
                  dict(facecolor="white", alpha=0.75, linewidth=0, pad=0.6))


def cost(figure, left, height, rows, cells):
    axes = figure.axes(left, TOP, WIDTH - 6 - left, height)
    axes.set(ylim=(len(rows), 0), xscale="log", yticks=[])
    figure.text(left, TOP - 10, "CPU of a cold drape,\nratio")
    for row, ingredient in enumerate(rows):
        ratios = [c["cpu_ratio"] for c in cells
                  if c["ingredient"] == ingredient["name"] and c.get("cpu_ratio")]
        dots(axes, row, ratios)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, 0.45), max(high, 2.2))
    axes.set_xticks([tick for tick in (0.1, 0.5, 1, 2, 5, 20) if axes.get_xlim()[0] <= tick
                     <= axes.get_xlim()[1]])
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.minorticks_off()
    axes.axvline(1, color=style.FAINT, linewidth=0.6, zorder=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def check(figure, left, top, result, rule, title):
    """Every fabric by what the rule sees and by what is so; agreement is in two of the quarters."""
    axes = figure.axes(left, top, 58, 44)
    agreement = result[rule]
    contact = rule == "contact_rule"
    across, limit = (("penetration", 1.0) if contact
                     else ("estimate", result["tolerance_points"]))
    up = "change" if contact else "error"
    known = [c for c in agreement["cells"] if c.get(up) is not None
             and (contact or c.get("same_branch"))]
    for c in known:
        x = 1e3 * c[across] if contact else c[across]
        y = abs(c[up])
        axes.plot(max(x, 1e-3), max(y, 1e-4), "o", color=style.ESTIMATE, markersize=3.5, alpha=0.8)
    axes.set(xscale="log", yscale="log", xlim=(5e-4, 60), ylim=(5e-5, 60))
    axes.minorticks_off()
    axes.axvline(limit, color=style.WARNING, linewidth=0.7)
    axes.axhline(result["tolerance_points"], color=style.WARNING, linewidth=0.7)
    axes.set_xlabel("penetration without contact, mm" if contact
                    else "estimated error of the coefficient, points")
    axes.set_ylabel("change by contact, points" if contact
                    else "difference from finest mesh, points")
    right, wrong = agreement["acts_where_needed"] + agreement["idle_where_not_needed"], \
        agreement["acts_needlessly"] + agreement["idle_where_needed"]
    axes.set_title(f"{title}: right for {right} of {right + wrong} fabrics;\ndoes not act where "
                   f"needed {agreement['idle_where_needed']}, acts needlessly "
                   f"{agreement['acts_needlessly']}", fontsize=7)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


if __name__ == "__main__":
    study.draw("ablation", __doc__, page)
