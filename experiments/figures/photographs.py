#!/usr/bin/python3
"""Fits of real drapes: for every fabric a photographed outline, the fit of it, and a prediction of
another picture of the fabric; then drape coefficients seen, fitted and predicted.

    /usr/bin/python3 photographs.py SUMMARY.json --out DIR/photographs    writes .png and .pdf"""
import numpy as np

import style
import study

CELL, COLUMNS = 40, 4
ROW = CELL + 12
HEAD = 17
PREDICTION = "#009E73"


def closed(profile):
    radius = np.array(profile + profile[:1])
    angle = np.radians(np.arange(len(radius)))
    return radius * np.cos(angle), radius * np.sin(angle)


def is_fit(item):
    return "parameters" in item


def is_free(item):
    return is_fit(item) and item["free"] and item["certified"]


def outline_cell(figure, left, top, label, item, colour):
    """The photographed shadow in grey, what was computed as a line."""
    axes = figure.axes(left, top + 6, CELL, CELL)
    axes.set(xlim=(-152, 152), ylim=(-152, 152), aspect="equal")
    axes.axis("off")
    if not is_fit(item):
        figure.text(left, top, f"{label}: {item['outcome']}", fontsize=6, color=style.WARNING)
        return
    axes.fill(*closed(item["seen"]["profile_mm"]), color="#D8D8D8", linewidth=0)
    axes.plot(*closed(item["profile_mm"]), color=colour, linewidth=0.8)
    seen = item["seen"]
    figure.text(left, top,
                f"{label}   DC {seen['drape_coefficient_percent']:.1f} → "
                f"{item['drape_coefficient_percent']:.1f}\n"
                f"{seen['node_count']} → {item['node_count']} nodes, "
                f"{style.number(item['outline_rms_mm'])} mm, IoU {item['iou']:.3f}",
                fontsize=6, linespacing=1.25)
    if not is_free(item):
        axes.text(0, 0, item["outcome"].replace("_", " "), color=style.WARNING, fontsize=6, ha="center",
                  va="center")


def scatter(axes, fabrics, model):
    """Drape coefficients of fits, predictions and protocols against those of the photographs."""
    axes.plot([0, 100], [0, 100], color=style.FAINT, linewidth=0.6)
    marks = {"fit": (style.ESTIMATE, "o"), "branch given": (PREDICTION, "^"),
             "branch not given": (style.START, "s")}
    points = {label: [] for label in marks}
    for row in fabrics:
        points["fit"] += [(item["seen"]["drape_coefficient_percent"],
                           item["drape_coefficient_percent"])
                          for item in row["fits"][model] if is_free(item)]
        points["branch given"] += [(item["seen"]["drape_coefficient_percent"],
                                    item["drape_coefficient_percent"])
                                   for item in row.get("predictions") or [] if is_free(item)]
        if "without_branch" in row:
            seen = row["photographs"]["drape_coefficients"]
            predicted = row["without_branch"]["drape_coefficient_percent"]
            by_all = row["without_branch"]["drape_coefficients"]
            points["branch not given"].append((np.median(seen), predicted))
            axes.plot([np.median(seen)] * 2, [min(by_all), max(by_all)], color=style.START,
                      linewidth=0.4)
            axes.plot([min(seen), max(seen)], [predicted] * 2, color=style.START, linewidth=0.4)
    for label, (colour, marker) in marks.items():
        x, y = np.array(points[label]).reshape(-1, 2).T
        axes.plot(x, y, marker, color=colour, markersize=2.5, linewidth=0, label=label)
    axes.set(xlim=(0, 100), ylim=(0, 100), xlabel="photographed", ylabel="computed")
    axes.set_title("Drape coefficient, %", fontsize=7)
    axes.legend(frameon=False, fontsize=6, loc="lower right")


def nodes(axes, fabrics):
    """Nodes of all photographs against those of the protocols' drapes."""
    for row in fabrics:
        if "without_branch" not in row:
            continue
        seen, by_all = (np.array(v) for v in (row["photographs"]["node_counts"],
                                              row["without_branch"]["node_counts"]))
        predicted = row["without_branch"]["node_count"]
        axes.errorbar(np.median(seen), predicted,
                      xerr=[[np.median(seen) - seen.min()], [seen.max() - np.median(seen)]],
                      yerr=[[predicted - by_all.min()], [by_all.max() - predicted]],
                      fmt="s", color=style.START, markersize=2.5, elinewidth=0.4)
    axes.plot([0, 18], [0, 18], color=style.FAINT, linewidth=0.6)
    axes.set(xlim=(0, 18), ylim=(0, 18), xlabel="photographed", ylabel="branch not given")
    axes.set_title("Nodes, bars: all photographs, protocols", fontsize=7)


def rigidities(axes, fabrics, model):
    """Effective rigidity of the fits of one fabric beside each other."""
    for i, row in enumerate(fabrics):
        for item in row["fits"][model]:
            if not is_free(item):
                continue
            axes.plot([i] * 3, 1e6 * np.array(item["rigidity"]), "o", color=style.ESTIMATE,
                      markersize=1.8, alpha=0.6)
    axes.set(yscale="log", xlabel="fabric", xlim=(-1, len(fabrics)))
    axes.set_xticks(range(len(fabrics)), [str(row["fabric"]) for row in fabrics], fontsize=6,
                    rotation=90 if len(fabrics) > 12 else 0)
    axes.set_title("$B_u$, $B_v$, $B_{45}$ of every fit, µN m", fontsize=7)


def page(summary):
    fabrics = summary["fabrics"]
    model = next(iter(fabrics[0]["fits"]))
    cells = [(f"fabric {row['fabric']}", row["fits"][model][0], style.ESTIMATE)
             for row in fabrics]
    cells += [(f"{row['fabric']}, other {row['predictions'][-1]['change']}",
               row["predictions"][-1], PREDICTION)
              for row in fabrics if row.get("predictions")]
    rows = -(-len(cells) // COLUMNS)
    figure = style.Page(190, HEAD + ROW * rows + 66)
    figure.text(6, 4, "Photographed drapes and their fits", fontsize=11, weight="bold")
    figure.text(6, 10.5, f"grey: photograph; blue: fit of that picture (model: {model}); green: "
                "another picture of the fabric from the parameters of the first, its branch given",
                fontsize=6.5)
    for i, (label, item, colour) in enumerate(cells):
        outline_cell(figure, 6 + (CELL + 5) * (i % COLUMNS), HEAD + ROW * (i // COLUMNS), label,
                     item, colour)
    top = HEAD + ROW * rows + 8
    scatter(figure.axes(16, top, 44, 44), fabrics, model)
    nodes(figure.axes(76, top, 44, 44), fabrics)
    rigidities(figure.axes(136, top, 48, 44), fabrics, model)
    return figure


if __name__ == "__main__":
    study.draw("photographs", __doc__, page)
