#!/usr/bin/python3
"""The gradient of the drape coefficient near a limit point, on the branch that ends there and on the
one that the drape snaps to.

    /usr/bin/python3 snap_gradient.py SNAP.json --out DIR/snap    writes .png and .pdf"""
from matplotlib.ticker import NullFormatter

import study
import style

PANELS = (("gradient", "|dDC/ds|, points"), ("smallest_eigenvalue", "smallest eigenvalue, N/m"),
          ("errors", "relative error of dDC/ds"))
STEPS = (style.START, "#CC79A7", "#009E73", "#56B4E9")
DASHES = ((4, 1.5), (1, 1.2), (6, 1, 1, 1), (2, 2))
LOWEST = 1e-11
WIDTH, HEIGHT, LEFT, TOP = 74, 42, 22, 36


def page(snap):
    figure = style.Page(182, TOP + 3 * (HEIGHT + 8) + 16)
    figure.text(6, 4, "The gradient where a branch ends", fontsize=11, weight="bold")
    figure.text(6, 10.5,
                f"s is the logarithm of the bending stiffness. At {snap['factor']:.4f} times the "
                f"fabric's stiffness the branch ends and a vertex jumps by "
                f"{1e3 * snap['vertex_jump']:.1f} mm.\nThe framework reports: "
                f"{snap['end'].replace('_', ' ')}, negative eigenvalues beyond it: "
                f"{snap['negative_eigenvalues_beyond']}; natural steps lost the branch "
                f"{snap['last_natural_step_distance']:.0e} before its end.\nLeft: the branch that "
                "ends; right: the one that the drape falls to. Errors are against extrapolated "
                "differences with steps of\na tenth of the distance and less; the grey line is what "
                "those leave open.")
    axes = {}
    for column, side in enumerate(("before", "after")):
        rows = [row for row in snap["rows"] if row["side"] == side and row["status"] == "converged"]
        lost = sum(row["side"] == side and row["status"] != "converged" for row in snap["rows"])
        for line, (name, words) in enumerate(PANELS):
            at = figure.axes(LEFT + (WIDTH + 8) * column, TOP + (HEIGHT + 8) * line, WIDTH, HEIGHT)
            axes[line, column] = at
            draw(at, rows, name)
            at.set(xscale="log", yscale="log")
            if column == 0:
                at.invert_xaxis()
                at.set_ylabel(words)
            else:
                at.yaxis.set_minor_formatter(NullFormatter())
            if line == len(PANELS) - 1:
                at.set_xlabel("distance of s before the limit point" if column == 0
                              else "distance of s beyond it")
            if line == 0 and lost:
                at.set_title(f"distances that could not be reached: {lost}", fontsize=7)
            for edge in ("top", "right"):
                at.spines[edge].set_visible(False)
    for line in range(len(PANELS)):
        low = min(axes[line, column].get_ylim()[0] for column in (0, 1))
        high = max(axes[line, column].get_ylim()[1] for column in (0, 1))
        for column in (0, 1):
            axes[line, column].set_ylim(low / 1.1, 1.1 * high)
            if PANELS[line][0] == "gradient":
                study.few_ticks(axes[line, column].yaxis)
            if column == 1:
                axes[line, column].yaxis.set_major_formatter(NullFormatter())
    legend(figure, snap, TOP + 3 * (HEIGHT + 8) + 7)
    return figure


def draw(axes, rows, name):
    distance = [row["distance"] for row in rows]
    if name != "errors":
        axes.plot(distance, [abs(row[name]) for row in rows], "-o", color=style.ESTIMATE,
                  markersize=2.6, linewidth=1)
        return
    axes.plot(distance, floor([row["reference_uncertainty"] for row in rows]), color=style.FAINT)
    axes.plot(distance, floor([row["adjoint_error"] for row in rows]), "-o", color=style.ESTIMATE,
              markersize=2.6, linewidth=1.4, zorder=4)
    for i, _ in enumerate(rows[0]["differences"] if rows else []):
        axes.plot(distance, floor([row["differences"][i]["error"] for row in rows]), "-",
                  color=STEPS[i % len(STEPS)], dashes=DASHES[i % len(DASHES)], linewidth=0.9)


def floor(values):
    return [float("nan") if value is None else max(value, LOWEST) for value in values]


def legend(figure, snap, top):
    steps = next((row["differences"] for row in snap["rows"] if row["status"] == "converged"), [])
    lines = [("adjoint", dict(color=style.ESTIMATE, linewidth=1.4))]
    lines += [(f"step {d['step']:.0e}", dict(color=STEPS[i % len(STEPS)], linewidth=0.9,
                                             dashes=DASHES[i % len(DASHES)]))
              for i, d in enumerate(steps)]
    for i, (words, look) in enumerate(lines):
        axes = figure.axes(8 + 34 * i, top, 8, 4)
        axes.axis("off")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.plot([0, 1], [0.5, 0.5], **look)
        figure.text(17.5 + 34 * i, top + 2, words, va="center")


if __name__ == "__main__":
    study.draw("gradient_precision", __doc__, page)
