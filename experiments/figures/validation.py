#!/usr/bin/python3
"""The model beside solutions that are not this code: strips, a plate, turned meshes.

    /usr/bin/python3 validation.py SUMMARY.json --out DIR/validation    writes .png and .pdf

The elastica is solved here once more, by finite differences and Newton's method, as a check of the
run's own shooting."""
import numpy as np

import style
import study

WIDTH, PANEL_WIDTH, PANEL_HEIGHT = 180, 46, 38  # mm
POISSON = -1 / 3


def elastica_drop(slenderness, steps=2000):
    """Drop over length of a heavy elastica, L = slenderness (B/q)^(1/3): theta'' = -c (1 - s)
    cos theta, theta(0) = 0, theta'(1) = 0, c = slenderness^3, second-order differences."""
    c, h = slenderness**3, 1 / steps
    s = np.arange(1, steps + 1) * h
    theta = np.zeros(steps)
    for load in np.linspace(0, 1, 9)[1:]:
        for _ in range(50):
            left = np.concatenate([[0], theta[:-1]])
            right = np.concatenate([theta[1:], [theta[-2]]])  # mirrored: theta'(1) = 0
            residual = (left - 2 * theta + right) / h**2 + load * c * (1 - s) * np.cos(theta)
            diagonal = -2 / h**2 - load * c * (1 - s) * np.sin(theta)
            step = _tridiagonal(h, diagonal, residual)
            theta -= step
            if np.abs(step).max() < 1e-12:
                break
    sine = np.concatenate([[0], np.sin(theta)])
    return h * (sine.sum() - (sine[0] + sine[-1]) / 2)


def _tridiagonal(h, diagonal, right):
    """Thomas's algorithm; off-diagonals 1/h^2, the last row 2/h^2 on its left."""
    off = 1 / h**2
    n = len(right)
    upper, value = np.empty(n), np.empty(n)
    upper[0], value[0] = off / diagonal[0], right[0] / diagonal[0]
    for i in range(1, n):
        lower = off if i < n - 1 else 2 * off
        pivot = diagonal[i] - lower * upper[i - 1]
        upper[i] = off / pivot
        value[i] = (right[i] - lower * value[i - 1]) / pivot
    for i in range(n - 2, -1, -1):
        value[i] -= upper[i] * value[i + 1]
    return value


def page(summary):
    studies, bias = summary["studies"], summary["mesh_bias"]
    rows = -(-len(bias) // 2)
    bias_height = 10 + 3.6 * rows if bias else 0
    figure = style.Page(WIDTH, 24 + 2 * (PANEL_HEIGHT + 20) + bias_height)
    figure.text(6, 4, "Validation against solutions that are not this code", fontsize=11,
                weight="bold")
    figure.text(6, 10.5, f"{summary['converged']} of {summary['solves']} solves at certified "
                f"minima; orders of convergence in the edge length: cantilever "
                f"{_value(summary['cantilever_order'], 1)}, plate "
                f"{_value(summary['plate_order'], 1)}")
    panels = [(cantilever, "slenderness"), (edge_lengths, "edge_length"), (widths, "width"),
              (hanging, None), (plate, None), (directions, "bent_direction")]
    for i, (draw, study) in enumerate(panels):
        left = 14 + i % 3 * (PANEL_WIDTH + 13)
        top = 21 + i // 3 * (PANEL_HEIGHT + 20)
        axes = figure.axes(left, top, PANEL_WIDTH, PANEL_HEIGHT)
        draw(axes, studies[study] if study else studies)
        axes.tick_params(pad=1.5)
    if bias:
        bias_table(figure, 21 + 2 * (PANEL_HEIGHT + 20) - 2, bias)
    return figure


def column(rows, name):
    return np.array([row[name] for row in rows], dtype=float)


def cantilever(axes, rows):
    slenderness = column(rows, "value")
    curve = np.linspace(0.8 * slenderness.min(), slenderness.max(), 24)
    plate = [elastica_drop(x) for x in curve]
    beam = [elastica_drop(x / (1 - POISSON**2) ** (1 / 3)) for x in curve]
    axes.fill_between(curve, plate, beam, color=style.ESTIMATE, alpha=0.25, linewidth=0)
    axes.plot(curve, plate, color=style.ESTIMATE, linewidth=0.8, label="elastica, B")
    axes.plot(curve, beam, color=style.ESTIMATE, linewidth=0.8, dashes=(3, 2),
              label="elastica, 8/9 B")
    for row in rows:
        drop = row["expected"] * (1 + np.array(row["errors"])) / 0.1
        axes.plot([row["value"]] * len(drop), drop, "o", color=style.WARNING, markersize=2.5)
    axes.set(xscale="log", yscale="log", xlabel="length / (B/q)$^{1/3}$",
             title="Cantilever: drop of the tip / length")
    axes.legend(frameon=False, fontsize=6)
    _finish(axes)


def edge_lengths(axes, rows):
    for row in rows:
        axes.plot([1e3 * row["value"]] * len(row["errors"]), 100 * np.abs(row["errors"]), "o",
                  color=style.FAINT, markersize=2.5)
    x, y = 1e3 * column(rows, "value"), 100 * np.abs(column(rows, "mean_error"))
    axes.plot(x, y, "o-", color=style.ESTIMATE, markersize=3, linewidth=0.8)
    axes.plot(x, y.max() * x / x.max(), color=style.TARGET, linewidth=0.6, dashes=(3, 2),
              label="order 1")
    axes.legend(frameon=False, fontsize=6, loc="upper left")
    axes.set(xscale="log", yscale="log", xlabel="edge length, mm",
             title="Cantilever: error of the drop, %")
    axes.set_xticks(x, [f"{value:g}" for value in x])
    axes.minorticks_off()
    _finish(axes)


def widths(axes, rows):
    x = 1e3 * column(rows, "value")
    axes.plot(x, column(rows, "rigidity_over_k"), "o-", color=style.ESTIMATE, markersize=3,
              linewidth=0.8, label="wings over their own area")
    axes.plot(x, column(rows, "mean_rigidity_over_k"), "s--", color=style.START, markersize=3,
              linewidth=0.8, label="over the strip's area")
    axes.axhline(4.15, color=style.FAINT, linewidth=0.6)
    axes.set(xscale="log", xlabel="width of the strip, mm", title="Rigidity of the mesh, B/k$_b$")
    axes.set_xticks(x, [f"{value:g}" for value in x])
    axes.minorticks_off()
    axes.legend(frameon=False, fontsize=6)
    _finish(axes)


def _directions(axes, rows, offset, colour, label):
    for i, row in enumerate(rows):
        errors = 100 * np.array(row["errors"])
        axes.plot(np.full(len(errors), i + offset), errors, "o", color=colour, markersize=2.5,
                  label=label if i == 0 else None)
    axes.set_xticks(range(len(rows)), ["weft", "45°", "warp"])
    axes.set_xlim(-0.5, len(rows) - 0.5)
    axes.axhline(0, color=style.FAINT, linewidth=0.6)


def hanging(axes, studies):
    small, large = studies["hanging_direction"], studies["hanging_far_stretched"]
    share = 100 * column(large, "expected") / 0.075
    _directions(axes, small, -0.12, style.ESTIMATE, "own weight")
    _directions(axes, large, 0.12, style.START,
                f"1000 g: stretched by {share.min():.1f} to {share.max():.0f} %")
    axes.set(title="Hanging strip: error of the stretch, %")
    axes.margins(y=0.35)
    axes.legend(frameon=False, fontsize=6)
    _finish(axes)


def directions(axes, rows):
    _directions(axes, rows, 0, style.ESTIMATE, None)
    axes.set(title="Cantilever: error of the drop, %")
    axes.margins(y=0.35)
    _finish(axes)


def plate(axes, studies):
    for name, colour, label in [("plate_single_clamp_weight", style.START, "1"),
                                ("plate", style.ESTIMATE, "2")]:
        rows = studies[name]
        axes.plot(column(rows, "value"), 100 * column(rows, "mean_error"), "-", color=colour,
                  linewidth=0.8, label=f"clamp wings of weight {label}")
        for row in rows:
            axes.plot([row["value"]] * len(row["errors"]), 100 * np.array(row["errors"]), "o",
                      color=colour, markersize=2.5)
    axes.axhline(0, color=style.FAINT, linewidth=0.6)
    x = column(rows, "value")
    axes.set(xscale="log", xlabel="vertices", title="Annular plate: error of the sag, %")
    axes.set_xticks(x, [f"{value:g}" for value in x])
    axes.minorticks_off()
    axes.legend(frameon=False, fontsize=6)
    _finish(axes)


def _finish(axes):
    axes.set_title(axes.get_title(), fontsize=7)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def bias_table(figure, top, bias):
    figure.text(6, top, "Mesh bias: drapes on meshes of several seeds, turned under the fabric",
                weight="bold")
    figure.text(6, top + 4, "DC in %: mean ± sd (sd over the turns of one mesh); direction of the "
                "folds: coherence with the fabric | with the mesh; most frequent nodes (range)", fontsize=6,
                color="#666666")
    half = -(-len(bias) // 2)
    for i, (group, row) in enumerate(bias.items()):
        left, line = 6 + i // half * 87, top + 9.5 + 3.6 * (i % half)
        counts = sorted(int(count) for count in row["nodes"])
        often = max(row["nodes"], key=row["nodes"].get, default="–")
        nodes = often if len(counts) < 2 else f"{often} ({counts[0]}–{counts[-1]})"
        figure.text(left, line, group.replace("anisotropic", "aniso.").replace("_", " "), fontsize=6)
        figure.text(left + 42, line, f"{_value(row['mean'], 1)} ± {_spread(row['sd'])} "
                    f"({_spread(row['sd_over_rotations'])})", fontsize=6)
        figure.text(left + 64.2, line, f"{_value(row['coherence_with_fabric'], 2)} | "
                    f"{_value(row['coherence_with_mesh'], 2)}", fontsize=6)
        figure.text(left + 77.3, line, nodes, fontsize=6)


def _spread(number):
    return _value(number, 2 if number is None or number < 10 else 1)


def _value(number, digits):
    return "–" if number is None else f"{number:.{digits}f}"


if __name__ == "__main__":
    study.draw("validation", __doc__, page)
