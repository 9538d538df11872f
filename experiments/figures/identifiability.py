#!/usr/bin/python3
"""What the outline of a drape says of each parameter, against the drape coefficient, for several
experiments on one fabric; and the directions that one picture sees best and worst.

    /usr/bin/python3 identifiability.py SUMMARY.json --out DIR/identifiability    writes .png and .pdf"""
import numpy as np

import style
import study

COLOURS = [style.ESTIMATE, style.START, "#009E73", style.TARGET]
SYMBOLS = {"k_u": "$k_u$", "k_v": "$k_v$", "k_h": "$k_h$", "k_bu": "$k_{bu}$", "k_bv": "$k_{bv}$",
           "k_bh": "$k_{bh}$"}


def running_median(x, y, width=15):
    """Medians of y over the fabrics within `width` points of each tenth drape coefficient."""
    centres = np.arange(10, 100, 5.0)
    medians = [np.nanmedian(y[near]) if (near := np.abs(x - c) <= width / 2).sum() >= 3 else np.nan
               for c in centres]
    return centres, np.array(medians)


def value(number):
    return np.nan if number is None else number


def sensitivity(figure, left, top, parameter, items, designs, first):
    axes = figure.axes(left, top, 42, 34)
    x = np.array([item["drape_coefficient_percent"] for item in items])
    for colour, design in zip(COLOURS, designs):
        y = np.array([value(item["designs"][design]["log_sd"][parameter]) for item in items])
        axes.plot(x, y, "o", color=colour, markersize=1.3, alpha=0.35, linewidth=0)
        axes.plot(*running_median(x, y), color=colour, linewidth=1.1, label=design)
    axes.axhline(1, color=style.FAINT, linewidth=0.6, dashes=(3, 2))
    axes.axhline(0.1, color=style.FAINT, linewidth=0.6, dashes=(3, 2))
    axes.set(yscale="log", xlim=(0, 100))
    axes.set_title(f"sd of ln {SYMBOLS.get(parameter, parameter)}", fontsize=7)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    if first:
        axes.legend(edgecolor="none", framealpha=0.8, fontsize=6)


def directions(figure, left, top, title, items, parameters, design):
    """Median share of each parameter in every direction, best seen first."""
    axes = figure.axes(left, top, 42, 30)
    squares = np.array([np.square(item["designs"][design]["directions"]) for item in items])
    sd = np.median([1 / np.array(item["designs"][design]["singular_values"]) for item in items],
                   axis=0)
    axes.imshow(np.median(squares, axis=0), cmap="Blues", vmin=0, vmax=1, aspect="auto")
    axes.set_xticks(range(len(parameters)), [SYMBOLS.get(p, p) for p in parameters])
    axes.set_yticks(range(len(sd)), [style.number(s) for s in sd])
    axes.set_ylabel("sd along the direction", fontsize=6)
    axes.set_title(title, fontsize=7)


def page(summary):
    parameters = summary["parameters"]
    items = [item for item in summary["items"] if item["status"] == "converged"]
    if not items:
        raise ValueError("no fabric was solved")
    designs = list(items[0]["designs"])
    rows = -(-len(parameters) // 3)
    figure = style.Page(180, 22 + 46 * rows + 48)
    figure.text(6, 4, "What outlines say of a fabric", fontsize=11, weight="bold")
    figure.text(6, 10.5, f"{len(items)} fabrics of the measured distribution against their drape "
                "coefficient in %; no prior; lines: running medians\nbelow 0.1 (dashed) a parameter "
                "is known to 10 %, above 1 (dashed) not at all", fontsize=6.5)
    for i, parameter in enumerate(parameters):
        sensitivity(figure, 14 + 58 * (i % 3), 22 + 46 * (i // 3), parameter, items, designs,
                    first=i == 0)
    known = [item for item in items
             if "directions" in item["designs"][designs[0]]]
    bands = [(0, 45), (45, 75), (75, 100)]
    for k, (low, high) in enumerate(bands):
        chosen = [i for i in known if low <= i["drape_coefficient_percent"] < high]
        if chosen:
            directions(figure, 20 + 57 * k, 28 + 46 * rows,
                       f"{designs[0]}, DC {low}–{high} %: {len(chosen)} fabrics", chosen,
                       parameters, designs[0])
    return figure


if __name__ == "__main__":
    study.draw("identifiability", __doc__, page)
