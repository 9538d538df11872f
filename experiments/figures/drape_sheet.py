#!/usr/bin/python3
"""One sheet of fabrics, like Fig. 2 of Ju et al. 2024: each with its drape from above, the outlines
of target, start and estimate, its tag and its parameters.

    /usr/bin/python3 drape_sheet.py RESULTS.h5 --out DIR/sheet      writes sheet.png and sheet.pdf
"""

import textwrap

import numpy as np

import results as records
import style

CELL_WIDTH, CELL_HEIGHT = 82, 90  # mm; 5 x 3 of them and the margins make an A3 sheet
PICTURE = 37
MARGIN, HEAD, FOOT = 5, 17, 8


def sheet(results):
    """The page with all records of `results`."""
    count = len(results.records)
    columns = min(max(count, 3), 5)
    rows = -(-count // columns)
    page = style.Page(2 * MARGIN + columns * CELL_WIDTH, HEAD + rows * CELL_HEIGHT + FOOT)
    page.text(MARGIN + 2, 4, "Drapes and the parameters found from their outlines", fontsize=12,
              weight="bold")
    page.text(MARGIN + 2, 11, summary(results), fontsize=7.5)
    page.legend(page.width - MARGIN - 66, 4)
    for i, record in enumerate(results.records):
        panel(page, MARGIN + i % columns * CELL_WIDTH, HEAD + i // columns * CELL_HEIGHT, results,
              record, style.FABRICS[i % len(style.FABRICS)])
    page.text(MARGIN + 2, page.height - 5,
              "Seen from above, weft to the right, warp up; axes in mm, ticks at the edge of the "
              f"support. DC: drape coefficient. Drape, commit {results.git_commit[:12]}",
              fontsize=6, color="#666666")
    return page


def summary(results):
    """One line on how the estimates went."""
    estimates = [record.estimate for record in results.records if record.estimate]
    text = f"{len(results.records)} fabrics"
    if estimates:
        succeeded = sum(estimate.succeeded for estimate in estimates)
        shared = sum(estimate.branch_shared for estimate in estimates)
        text += (f"; estimates succeeded: {succeeded} of {len(estimates)}; start and target on one "
                 f"branch: {shared} of {len(estimates)}")
    return text


def panel(page, left, top, results, record, colour):
    """One fabric."""
    left += 2
    tag(page, left, top, record)
    pictures = top + 16
    if np.isfinite(record.positions).all():
        style.draw_drape(page.axes(left, pictures, PICTURE, PICTURE), results, record.positions,
                         colour)
    else:
        page.text(left + PICTURE / 2, pictures + PICTURE / 2,
                  wrapped(f"no drape: {record.status}", 24), ha="center", va="center",
                  color=style.WARNING)
    axes = page.axes(left + PICTURE + 6, pictures + 0.5, PICTURE - 2, PICTURE - 2)
    outlines(axes, results, record)
    table(page, left, pictures + PICTURE + 4, record)


def wrapped(text, width, lines=3):
    return "\n".join(textwrap.wrap(text, width, max_lines=lines, placeholder=" …"))


def tag(page, left, top, record):
    """Identifier, type, composition and weight: the tag row."""
    kind = [record.tag[name] for name in ("category", "subcategory") if record.tag[name]]
    weight = f"{style.number(1e3 * record.parameters['areal_density'])} g/m²"
    title = record.tag["type"] or record.tag["name"]
    page.text(left, top, wrapped(f"{record.id}   {title}", 42, 1), fontsize=9, weight="bold")
    page.text(left, top + 4.8, wrapped(", ".join(kind + [weight]), 62, 1))
    page.text(left, top + 8.2, wrapped(record.tag["composition"], 62, 2), linespacing=1.15)


def outlines(axes, results, record):
    """Target, start and estimate over each other; what went wrong in words."""
    estimate = record.estimate
    profiles = {"target": record.profile}
    if estimate:
        profiles |= {"start": estimate.start_profile, "estimate": estimate.profile}
    style.draw_outlines(axes, results, {label: profile for label, profile in profiles.items()
                                        if np.isfinite(profile).all()})
    words = "no estimate" if not estimate else "" if estimate.succeeded else estimate.outcome
    if words:
        axes.text(0, 0, wrapped(words, 20, 5), ha="center", va="center", fontsize=6.5,
                  color=style.WARNING)


def table(page, left, top, record):
    """Parameters true, start, estimated and the error; below, what the silhouette says."""
    estimate = record.estimate
    ends = [left + x for x in (30, 44, 60, 77)]  # right edges of the columns
    line_height = 3.7

    def row(line, cells, **options):
        for end, cell in zip(ends, cells):
            page.text(end, line, cell, ha="right", va="baseline", **options)

    line = top + 2.4
    row(line, ["true", "start", "estimated", "error"] if estimate else ["true"], color="#666666",
        fontsize=6.5)
    for name, (symbol, unit, scale) in style.PARAMETERS.items():
        line += line_height
        page.text(left, line, symbol, va="baseline", fontsize=7.5)
        page.text(left + 7, line, unit, va="baseline", color="#666666", fontsize=6.5)
        cells = [record.parameters[name]]
        if estimate:
            cells += [estimate.start[name], estimate.parameters[name]]
        texts = [style.number(scale * value) for value in cells]
        if estimate:
            texts.append(style.change(cells[2], cells[0]))
        row(line, texts, fontsize=7.5)
    line += line_height + 1
    if not estimate:
        page.text(left, line, f"DC {style.percent(record.drape_coefficient)}    nodes "
                              f"{record.node_count}", va="baseline")
        return
    page.text(left, line,
              f"DC {style.percent(record.drape_coefficient)} → "
              f"{style.percent(estimate.drape_coefficient)}    nodes {record.node_count} → "
              f"{estimate.node_count}    outline {style.millimetres(estimate.outline_rms)} rms",
              va="baseline")
    page.text(left, line + line_height, "start and target share a branch" if estimate.branch_shared
              else "start and target lie on different branches", va="baseline", fontsize=6.5,
              color="#666666" if estimate.branch_shared else style.WARNING)


if __name__ == "__main__":
    records.draw("a run", __doc__, sheet)
