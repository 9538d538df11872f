#!/usr/bin/python3
"""Error of the drape coefficient on one branch against the CPU time of a cold drape.

    /usr/bin/python3 accuracy.py SUMMARY.json --out DIR/accuracy    writes .png and .pdf"""
import numpy as np

import style
import study

COLOURS = {"stiff": style.ESTIMATE, "medium": style.START, "soft": style.WARNING}


def page(summary):
    figure = style.Page(180, 86)
    figure.text(6, 4, "Accuracy of the drape coefficient", fontsize=11, weight="bold")
    figure.text(6, 10.5, f"against a reference of {summary['reference_vertices']} vertices on the "
                "same branch (same nodes, outlines less than 2 mm apart);\nmedians over mesh seeds "
                f"and {summary['fabrics']} fabrics, bars to the 95th percentile; hollow: same "
                "nodes, any distance")
    error = figure.axes(14, 28, 44, 44)
    time = figure.axes(74, 28, 44, 44)
    share = figure.axes(132, 28, 44, 44)
    for softness, rows in summary["per_softness"].items():
        vertices = np.array([float(name) for name in rows])
        colour = COLOURS[softness]
        median, upper, loose, cpu, matched, cold = (
            np.array([np.nan if row[name] is None else row[name] for row in rows.values()])
            for name in ("error_median", "error_95", "same_nodes_error_median",
                         "cold_cpu_seconds_median",
                         "matched_share", "cold_matched_share"))
        for axes, x in ((error, vertices), (time, cpu)):
            axes.plot(x, loose, "o:", color=colour, markersize=3, markerfacecolor="none",
                      linewidth=0.6, label=softness)
            if np.isnan(median).all():
                continue
            axes.errorbar(x, median, yerr=[np.zeros_like(median), upper - median], fmt="o-",
                          color=colour, markersize=3, linewidth=0.8, elinewidth=0.5)
        share.plot(vertices, 100 * matched, "o-", color=colour, markersize=3, linewidth=0.8)
        share.plot(vertices, 100 * cold, "s--", color=colour, markersize=3, linewidth=0.8)
    for axes, goal_colour in ((error, style.FAINT), (time, style.FAINT)):
        for goal in (0.5, 1):
            axes.axhline(goal, color=goal_colour, linewidth=0.6, dashes=(3, 2))
        axes.set(xscale="log", yscale="log")
        axes.legend(frameon=False, fontsize=6)
    ticks = sorted({float(name) for rows in summary["per_softness"].values() for name in rows})
    for axes in (error, share):
        axes.set_xscale("log")
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.minorticks_off()
        axes.set_xlabel("vertices")
    error.set_title("Error of the drape coefficient, points", fontsize=7)
    time.set(xlabel="CPU time of a cold drape, s")
    time.set_title("Error against time", fontsize=7)
    share.set(ylim=(-3, 103))
    share.set_title("On the reference's branch, %\n(followed; dashed: cold)", fontsize=7)
    for axes in (error, time, share):
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    return figure


if __name__ == "__main__":
    study.draw("accuracy", __doc__, page)
