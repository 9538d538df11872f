#!/usr/bin/python3
"""Parameters found from outlines against the true ones, over all fabrics of a recovery.

    /usr/bin/python3 recovery.py RESULTS.h5 --out DIR/recovery      writes recovery.png and .pdf
"""

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

import results as records
import style

COLUMNS = 5
PANEL, GAP_X, GAP_Y = 32, 13, 17  # mm
MARGIN, HEAD, FOOT = 14, 22, 9

LABELS = {
    "areal_density": "areal density [kg/m²]", "k_u": "$k_u$ [N/m]", "k_v": "$k_v$ [N/m]",
    "k_h": "$k_h$ [N/m]", "k_bu": "$k_{bu}$ [N m]", "k_bv": "$k_{bv}$ [N m]",
    "k_bh": "$k_{bh}$ [N m]", "s_bu": "$s_{bu}$", "s_bv": "$s_{bv}$", "s_bh": "$s_{bh}$",
    "t_bu": "$t_{bu}$", "t_bv": "$t_{bv}$", "t_bh": "$t_{bh}$",
}
OUTCOMES = {  # from good to bad: label, colour, marker
    "succeeded": ("explains the outline", style.ESTIMATE, "o"),
    "misfit": ("free, a misfit remains", style.START, "s"),
    "not_converged": ("not converged", "#CC79A7", "D"),
    "other": ("branch lost or no start", style.WARNING, "x"),
}


def outcome_of(record):
    return record.estimate.outcome if record.estimate.outcome in OUTCOMES else "other"


def estimated(fits):
    """The parameters that were estimated: those that some start has wrong."""
    return [name for name in LABELS
            if any(not np.isclose(fit.estimate.start[name], fit.parameters[name], rtol=1e-9)
                   for fit in fits)]


def scatter(axes, fits, x, y):
    for outcome, (_, colour, marker) in OUTCOMES.items():
        chosen = [fit for fit in fits if outcome_of(fit) == outcome]
        axes.scatter([x(fit) for fit in chosen], [y(fit) for fit in chosen], s=9, color=colour,
                     marker=marker, linewidths=0.7 if marker == "x" else 0, alpha=0.8)


def parameter_panel(axes, fits, name):
    axes.set(xscale="log", yscale="log")
    scatter(axes, fits, lambda fit: fit.parameters[name], lambda fit: fit.estimate.parameters[name])
    values = [value for fit in fits
              for value in (fit.parameters[name], fit.estimate.parameters[name]) if value > 0]
    centre, reach = np.sqrt(min(values) * max(values)), np.sqrt(max(values) / min(values))
    limits = (centre / max(1.5 * reach, 4), centre * max(1.5 * reach, 4))  # at least a decade
    axes.plot(limits, limits, color=style.FAINT, linewidth=0.6, zorder=0)
    axes.set(xlim=limits, ylim=limits, aspect="equal", xlabel="true", ylabel="estimated")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
    errors = [abs(np.log(fit.estimate.parameters[name] / fit.parameters[name])) for fit in fits]
    axes.set_title(f"{LABELS[name]}\nmedian |ln error| {style.number(np.median(errors))}",
                   fontsize=7)


def outline_panel(axes, fits):
    axes.set(yscale="log", xlim=(0, 100), xlabel="drape coefficient [%]", ylabel="outline rms [mm]")
    scatter(axes, fits, lambda fit: 100 * fit.drape_coefficient,
            lambda fit: max(1e3 * fit.estimate.outline_rms, 1e-6))
    axes.set_ylim(5e-7, max(10, axes.get_ylim()[1]))
    axes.yaxis.set_major_locator(LogLocator(base=100))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_title("What is left of the outline\n(at least $10^{-6}$ shown)", fontsize=7)


def page_of(results):
    fits = [record for record in results.records
            if record.estimate and np.isfinite(record.estimate.outline_rms)]
    names = estimated(fits)
    rows = -(-(len(names) + 1) // COLUMNS)
    page = style.Page(2 * MARGIN + COLUMNS * PANEL + (COLUMNS - 1) * GAP_X,
                      HEAD + rows * (PANEL + GAP_Y) + FOOT)
    page.text(MARGIN, 4, "Parameters found from the outlines", fontsize=10, weight="bold")
    legend(page, fits, len(results.records))
    for i, name in enumerate(names + ["outline"]):
        axes = page.axes(MARGIN + i % COLUMNS * (PANEL + GAP_X),
                         HEAD + 4 + i // COLUMNS * (PANEL + GAP_Y), PANEL, PANEL)
        if name == "outline":
            outline_panel(axes, fits)
        else:
            parameter_panel(axes, fits, name)
    page.text(MARGIN, page.height - 5, f"Drape, commit {results.git_commit[:12]}", fontsize=6,
              color="#666666")
    return page


def legend(page, fits, total):
    axes = page.axes(MARGIN, 10, page.width - 2 * MARGIN, 5)
    axes.set(xlim=(0, page.width - 2 * MARGIN), ylim=(0, 5))
    axes.axis("off")
    left = 1
    for outcome, (label, colour, marker) in OUTCOMES.items():
        count = sum(outcome_of(fit) == outcome for fit in fits)
        axes.scatter([left], [2.5], s=10, color=colour, marker=marker)
        axes.text(left + 2, 2.5, f"{label}: {count} of {total}", va="center")
        left += 52


if __name__ == "__main__":
    records.draw("a run of kind estimate", __doc__, page_of)
