#!/usr/bin/python3
"""The estimate of one fabric from its outlines, photographs for example: for each the estimated drape
from above and the outlines of target, start and estimate; then the parameters.

    /usr/bin/python3 estimate_overlay.py RESULTS.h5 --out DIR/overlay   writes overlay.png and .pdf
"""

import numpy as np

import results as records
import style
from drape_sheet import wrapped

PICTURE = 80  # side of a picture's axes
ROW = PICTURE + 12
HEAD = 11


def page_of(results):
    """The page of one fabric: a row for each record with an estimate, which they share."""
    estimated = [record for record in results.records if record.estimate]
    fabrics = {tuple(record.estimate.parameters.values()) for record in estimated}
    if len(fabrics) != 1:
        raise ValueError(f"holds estimates of {len(fabrics)} fabrics, this figure shows exactly one")
    first = estimated[0]
    table_top = HEAD + ROW * len(estimated) + 2
    page = style.Page(2 * PICTURE + 22, table_top + 4 * len(style.PARAMETERS) + 31)
    name = first.tag["name"] or first.tag["type"]
    title = f"{first.id}   {name}" if name != first.id else name
    if len(estimated) > 1:
        title += f" and {len(estimated) - 1} more"
    page.text(5, 4, wrapped(title, 55, 1), fontsize=11, weight="bold")
    page.legend(page.width - 71, 4)
    for i, record in enumerate(estimated):
        picture_row(page, HEAD + ROW * i, results, record, show_id=len(estimated) > 1)
    table(page, 5, table_top, first)
    rigidity(page, 5, table_top + 4 * (len(style.PARAMETERS) + 1) + 1, first.estimate)
    if not first.estimate.succeeded:
        page.text(5, page.height - 10,
                  wrapped(f"The estimate did not succeed: {first.estimate.outcome}", 105, 1),
                  color=style.WARNING, fontsize=8)
    page.text(5, page.height - 5, f"Drape, commit {results.git_commit[:12]}", fontsize=6,
              color="#666666")
    return page


def picture_row(page, top, results, record, show_id):
    """The estimated drape as the picture shows it, and the outlines."""
    estimate = record.estimate
    page.text(5, top + 1, wrapped(f"Estimated drape, {record.id}", 50, 1) if show_id
              else "Estimated drape from above", fontsize=8)
    page.text(PICTURE + 14, top + 1,
              f"Outline, rms {style.millimetres(estimate.outline_rms)}, "
              f"IoU {estimate.iou:.3f}, nodes {record.node_count} → {estimate.node_count}, "
              f"DC {style.percent(record.drape_coefficient)} → "
              f"{style.percent(estimate.drape_coefficient)}", fontsize=6)
    if np.isfinite(estimate.positions).all():
        cosine, sine = np.cos(estimate.weft_angle), np.sin(estimate.weft_angle)
        turned = estimate.positions @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
        style.draw_drape(page.axes(5, top + 6, PICTURE, PICTURE), results, turned, style.FABRICS[0])
    style.draw_outlines(page.axes(PICTURE + 14, top + 7, PICTURE, PICTURE), results,
                        {"target": record.profile, "start": estimate.start_profile,
                         "estimate": estimate.profile})


def interval(value, log_sd):
    factor = np.exp(log_sd)
    return (f"{style.number(value / factor)} – {style.number(value * factor)}"
            if np.isfinite(factor) else "–")


def table(page, left, top, record):
    """The parameters."""
    estimate = record.estimate
    ends = [left + x for x in (38, 56, 80)]
    for end, head in zip(ends, ("start", "estimated", "1 sd interval")):
        page.text(end, top, head, ha="right", color="#666666")
    for i, (name, (symbol, unit, scale)) in enumerate(style.PARAMETERS.items()):
        line = top + 4 * (i + 1)
        value = scale * estimate.parameters[name]
        page.text(left, line, f"{symbol}  [{unit}]", fontsize=8)
        for end, text in zip(ends, (style.number(scale * estimate.start[name]),
                                    style.number(value), interval(value, estimate.log_sd[name]))):
            page.text(end, line, text, ha="right", fontsize=8)
    page.text(PICTURE + 14, top, "areal density", color="#666666", fontsize=8)
    page.text(PICTURE + 56, top, f"{style.number(1e3 * record.parameters['areal_density'])} g/m²",
              fontsize=8)


def rigidity(page, left, top, estimate):
    """The effective rigidities, which are better known than the single stiffnesses."""
    for i, symbol in enumerate(("$B_u$", "$B_v$", "$B_{45}$")):
        value = 1e6 * estimate.rigidity[i]
        if np.isfinite(value):
            page.text(left, top + 4 * i, f"{symbol}  [µN m]", fontsize=8)
            page.text(left + 56, top + 4 * i, style.number(value), ha="right", fontsize=8)
            page.text(left + 80, top + 4 * i, interval(value, estimate.rigidity_log_sd[i]),
                      ha="right", fontsize=8)


if __name__ == "__main__":
    records.draw("a run of kind estimate", __doc__, page_of)
