#!/usr/bin/python3
"""The estimate of one fabric from its outline, a photograph's for example: the estimated drape from
above, the outlines of target, start and estimate, and the parameters.

    /usr/bin/python3 estimate_overlay.py RESULTS.h5 --out DIR/overlay   writes overlay.png and .pdf
"""

import argparse
import sys

import numpy as np

import results as records
import style
from drape_sheet import wrapped

PICTURE = 80


def overlay(results, record):
    """The page of `record`, which must have an estimate."""
    estimate = record.estimate
    page = style.Page(2 * PICTURE + 22, PICTURE + 60)
    name = record.tag["name"] or record.tag["type"]
    page.text(5, 4, wrapped(f"{record.id}   {name}" if name != record.id else name, 55, 1),
              fontsize=11, weight="bold")
    page.legend(page.width - 71, 4)
    page.text(5, 12, "Estimated drape from above", fontsize=8)
    page.text(PICTURE + 14, 12, "Outline of the shadow [mm]", fontsize=8)
    if np.isfinite(estimate.positions).all():
        style.draw_drape(page.axes(5, 17, PICTURE, PICTURE), results, estimate.positions,
                         style.FABRICS[0])
    style.draw_outlines(page.axes(PICTURE + 14, 18, PICTURE, PICTURE), results,
                        {"target": record.profile, "start": estimate.start_profile,
                         "estimate": estimate.profile})
    if not estimate.succeeded:
        page.text(5, page.height - 10, wrapped(f"The estimate did not succeed: {estimate.outcome}",
                                               105, 1), color=style.WARNING, fontsize=8)
    table(page, 5, PICTURE + 25, record)
    page.text(5, page.height - 5, f"Drape, commit {results.git_commit[:12]}", fontsize=6,
              color="#666666")
    return page


def table(page, left, top, record):
    """Parameters at the left, the fit at the right."""
    estimate = record.estimate
    ends = [left + x for x in (38, 56, 80)]
    for end, head in zip(ends, ("start", "estimated", "1 sd interval")):
        page.text(end, top, head, ha="right", color="#666666")
    for i, (name, (symbol, unit, scale)) in enumerate(style.PARAMETERS.items()):
        line = top + 4 * (i + 1)
        value, factor = scale * estimate.parameters[name], np.exp(estimate.log_sd[name])
        interval = (f"{style.number(value / factor)} – {style.number(value * factor)}"
                    if np.isfinite(factor) else "–")
        page.text(left, line, f"{symbol}  [{unit}]", fontsize=8)
        for end, text in zip(ends, (style.number(scale * estimate.start[name]),
                                    style.number(value), interval)):
            page.text(end, line, text, ha="right", fontsize=8)
    facts = [
        ("areal density", f"{style.number(1e3 * record.parameters['areal_density'])} g/m²"),
        ("outline, rms", style.millimetres(estimate.outline_rms)),
        ("intersection over union", f"{estimate.iou:.3f}"),
        ("drape coefficient", f"{style.percent(record.drape_coefficient)} → "
                              f"{style.percent(estimate.drape_coefficient)}"),
        ("nodes", f"{record.node_count} → {estimate.node_count}"),
    ]
    for i, (fact, value) in enumerate(facts):
        page.text(PICTURE + 14, top + 4 * i, fact, color="#666666", fontsize=8)
        page.text(PICTURE + 56, top + 4 * i, value, fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", help="a results.h5 of Drape")
    parser.add_argument("--out", required=True, help="path of the figure without its suffix")
    arguments = parser.parse_args()
    results = records.read(arguments.results)
    estimated = [record for record in results.records if record.estimate]
    if len(estimated) != 1:
        print(f"{arguments.results}: holds {len(estimated)} estimates, this figure shows exactly one",
              file=sys.stderr)
        sys.exit(2)
    for file in overlay(results, estimated[0]).save(arguments.out):
        print(file)


if __name__ == "__main__":
    main()
