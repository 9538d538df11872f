#!/usr/bin/python3
"""Error of a gradient against CPU time and memory, by four ways to differentiate.

    /usr/bin/python3 gradient_precision.py GRADIENTS.json --out DIR/gradients   writes .png and .pdf"""
import study
import style

COLOURS = {"adjoint": style.ESTIMATE, "sensitivities": "#56B4E9", "differences": style.START,
           "unrolled": "#CC79A7"}
WORDS = {"adjoint": "adjoint, equilibrium to a residual of", "sensitivities":
         "forward sensitivities, residual", "differences": "central differences, step",
         "unrolled": "back through implicit Euler, steps"}
DASHES = ((None, None), (4, 1.5), (1, 1.2), (6, 1, 1, 1))
LOWEST = 1e-11


def page(result):
    rows = [row for row in result["rows"] if row["status"] == "converged"]
    failed = len(result["rows"]) - len(rows)
    series = list(dict.fromkeys((row["method"], row["series"]) for row in rows))
    figure = style.Page(182, 112 + 4.5 * -(-len(series) // 2))
    figure.text(6, 4, "A gradient's error against what it costs", fontsize=11, weight="bold")
    figure.text(6, 10.5,
                f"Outline of a drape of {result['vertices']} vertices by {result['parameters']} "
                "parameters, the equilibrium's solve included. Error: largest entry, over the "
                "gradient's\nlargest. The reference is the adjoint at the rounding floor; "
                "extrapolated differences agree with it within "
                f"{result['reference_disagreement']:.0e} (line)."
                + (f" Settings that failed: {failed}." if failed else ""))
    for column, (name, unit, scale) in enumerate((("cpu_seconds", "CPU time, s", 1),
                                                  ("memory_bytes", "peak memory, MB", 1e-6))):
        axes = figure.axes(16 + 88 * column, 24, 72, 66)
        for method, value in series:
            draw(axes, [row for row in rows if (row["method"], row["series"]) == (method, value)],
                 name, scale, dashes(series, method, value))
        axes.axhline(result["reference_disagreement"], color=style.FAINT, linewidth=0.6)
        axes.set(xscale="log", yscale="log", xlabel=unit)
        study.few_ticks(axes.xaxis)
        if column == 0:
            axes.set_ylabel("relative error")
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    for i, (method, value) in enumerate(series):
        left, top = 8 + 88 * (i % 2), 103 + 4.5 * (i // 2)
        axes = figure.axes(left, top, 8, 4)
        axes.axis("off")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.plot([0, 1], [0.5, 0.5], color=COLOURS[method], dashes=dashes(series, method, value))
        figure.text(left + 9.5, top + 2, label(method, value, rows), va="center")
    return figure


def dashes(series, method, value):
    return DASHES[[v for m, v in series if m == method].index(value) % len(DASHES)]


def label(method, value, rows):
    settings = [row["setting"] for row in rows if (row["method"], row["series"]) == (method, value)]
    extra = {"differences": f", residual {value:.0e}", "unrolled": f" of {value:g} s"}.get(method, "")
    return f"{WORDS[method]} {settings[0]} to {settings[-1]}{extra}"


def draw(axes, rows, name, scale, dashed):
    colour = COLOURS[rows[0]["method"]]
    points = [(scale * row[name], max(row["error"], LOWEST)) for row in rows
              if row[name] is not None]
    if not points:
        return
    axes.plot(*zip(*points), "-o", color=colour, dashes=dashed, markersize=2.4, linewidth=0.9)


if __name__ == "__main__":
    study.draw("gradient_precision", __doc__, page)
