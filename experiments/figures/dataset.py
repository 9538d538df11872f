#!/usr/bin/python3
"""A dataset at a glance: types and fibres as in Tables 1 and 2 of Ju et al. 2024, weight against
bending over the measured fabrics, drape coefficients and nodes beside those of photographs, and a
contact sheet with a drape of every type.

    /usr/bin/python3 dataset.py RESULTS.h5 --out DIR/dataset    writes dataset.png and dataset.pdf
"""

import argparse
import csv
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np

import style

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"  # measured fabrics, where they are

COLOURS = {"Woven": "#0072B2", "Cut & Sew knit": "#E69F00", "Animal alternatives": "#009E73",
           "Non-fabric": "#CC79A7", "": "#777777"}

# B / 4 = RIGIDITY @ k_b for (B_u, B_v, B_45) and (k_bu, k_bv, k_bh) on isotropic meshes.
RIGIDITY = np.array([[.588, .047, .365], [.047, .588, .365], [.182, .182, .635]])

MARGIN, HEAD = 5, 18
BAR = 2.9  # mm a bar
COLUMNS, ROWS = 11, 6  # of the contact sheet
CELL = (26.6, 30)


def read(path):
    """The small columns of a table, and the file for the positions of single records."""
    file = h5py.File(path, "r")
    text = {name: file[f"fabric/{name}"].asstr()[...]
            for name in ("id", "category", "type", "composition")}
    names = ("areal_density", "k_bu", "k_bv", "k_bh")
    return SimpleNamespace(
        **text, file=file, count=len(text["id"]),
        **{name: file[f"params/{name}"][...] for name in names},
        drape_coefficient=file["observation/drape_coefficient"][...],
        nodes=file["observation/node_count"][...],
        converged=file["stats/status"].asstr()[...] == "converged",
        support_radius=float(file.attrs["support_radius"]),
        specimen_radius=float(file.attrs["specimen_radius"]),
        git_commit=str(file.attrs["git_commit"]),
        triangles=file[f"mesh/{file['sim'].attrs['mesh']}/triangles"][...])


def measured(name):
    """Rows of a table of measured fabrics; none where it is not there."""
    file = DATA / name
    if not file.is_file():
        return []
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def bars(page, left, top, width, title, counts, colour):
    """Horizontal bars, the largest at the top; `counts`: label -> count."""
    page.text(left, top, title, fontsize=8, weight="bold")
    labels = sorted(counts, key=lambda label: (-counts[label], label))
    indent = 40
    axes = page.axes(left + indent, top + 5, width - indent - 8, BAR * len(labels))
    places = np.arange(len(labels))
    values = [counts[label] for label in labels]
    axes.barh(places, values, height=0.72, color=[colour(label) for label in labels])
    axes.set(ylim=(len(labels) - 0.5, -0.5), xlim=(0, max(values) * 1.02))
    axes.axis("off")
    for place, label, value in zip(places, labels, values):
        axes.text(0, place, label + " ", ha="right", va="center", fontsize=6)
        axes.text(value, place, f" {value}", va="center", fontsize=6, color="#666666")


def types(page, left, top, width, table):
    """Table 1: one bar a type, in the colour of its category."""
    category = dict(zip(table.type, table.category))
    counts = Counter(table.type)
    bars(page, left, top, width, f"{len(counts)} types", counts,
         lambda label: COLOURS.get(category[label], COLOURS[""]))


def categories(page, table):
    """The key of the colours, in one row."""
    shown = [name for name in COLOURS if name in set(table.category)]
    for i, name in enumerate(shown):
        page.text(page.width - MARGIN - 34 * (len(shown) - i), 11, name or "no tag",
                  color=COLOURS[name], weight="bold", fontsize=6.5)


def fibres(page, left, top, width, table):
    """Table 2: in how many fabrics each fibre is."""
    counts = Counter(part.strip().rpartition(" ")[0] for text in table.composition
                     for part in text.split(";") if part.strip())
    if counts:
        bars(page, left, top, width, f"{len(counts)} fibres, {sum(counts.values())} mentions",
             counts, lambda label: "#5B6B7B")


def weight_and_bending(page, left, top, width, height, table):
    """Mean rigidity against weight, the measured fabrics behind."""
    page.text(left, top, "Weight and bending", fontsize=8, weight="bold")
    axes = page.axes(left + 10, top + 5, width - 10, height - 14)
    rows = measured("drapetester_618_bending.csv")
    if rows:
        weight = [1e3 * float(row["density_kg_m2"]) for row in rows]
        mean = [1e-3 * sum(float(row[f"lin_{d}"]) for d in ("warp", "weft", "diag")) / 3
                for row in rows]
        axes.scatter(weight, mean, s=5, color=style.FAINT, linewidth=0)
        page.text(left + 34, top + 0.7, "grey: 618 measured fabrics (Feng et al. 2022)",
                  fontsize=6, color="#666666")
    rigidity = 4 * RIGIDITY @ np.array([table.k_bu, table.k_bv, table.k_bh])
    size = np.clip(2000 / max(table.count, 1), 1.5, 8)
    for name, colour in COLOURS.items():
        of = table.category == name
        if of.any():
            axes.scatter(1e3 * table.areal_density[of], 1e6 * rigidity.mean(axis=0)[of], s=size,
                         color=colour, linewidth=0, alpha=0.8)
    axes.set(xscale="log", yscale="log", xlabel="g/m²")
    axes.set_ylabel("mean B, µN m", labelpad=1)
    axes.xaxis.set_minor_formatter(lambda *_: "")


def histogram(page, left, top, width, height, title, values, edges, photographs):
    """A histogram; short lines below the axis mark photographed fabrics."""
    page.text(left, top, title, fontsize=8, weight="bold")
    axes = page.axes(left, top + 8, width, height - 17)
    axes.hist(values, bins=edges, color=style.ESTIMATE, alpha=0.8)
    axes.set(xlim=(edges[0], edges[-1]))
    axes.set_yticks([])
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
    if photographs:
        axes.plot(photographs, np.zeros(len(photographs)), "|", color=style.WARNING, markersize=9,
                  clip_on=False)


def chosen(table):
    """Indices for the contact sheet: one drape of every type, then others; by drape coefficient."""
    solved = np.flatnonzero(table.converged)
    seen, first, others = set(), [], []
    for index in solved:
        (others if table.type[index] in seen else first).append(index)
        seen.add(table.type[index])
    picked = (first + others)[:64]
    return sorted(picked, key=lambda index: -table.drape_coefficient[index])


def contact_sheet(page, top, table):
    indices = chosen(table)
    types_shown = len({table.type[index] for index in indices})
    page.text(MARGIN, top, f"{len(indices)} drapes of {types_shown} types, from stiff to soft",
              fontsize=8, weight="bold")
    for i, index in enumerate(indices):
        left = MARGIN + i % COLUMNS * CELL[0]
        line = top + 6 + i // COLUMNS * CELL[1]
        colour = COLOURS.get(table.category[index], COLOURS[""])
        style.draw_drape(page.axes(left + 2, line, CELL[0] - 4, CELL[0] - 4), table,
                         table.file["sim/positions"][index], colour)
        name = table.type[index] or table.id[index]
        page.text(left + CELL[0] / 2, line + CELL[0] - 3.6,
                  name if len(name) < 21 else name[:19] + "…", fontsize=6, ha="center")
        page.text(left + CELL[0] / 2, line + CELL[0] - 0.9,
                  f"{100 * table.drape_coefficient[index]:.0f} %, {table.nodes[index]} nodes",
                  fontsize=6, ha="center", color="#666666")


def picture(table):
    type_rows = len(set(table.type))
    fibre_rows = len({part.strip().rpartition(" ")[0] for text in table.composition
                      for part in text.split(";") if part.strip()})
    bars_height = 10 + BAR * max(type_rows, fibre_rows)
    chart = max(bars_height / 2, 58)
    upper = max(bars_height, 2 * chart)
    sheet_rows = -(-min(int(table.converged.sum()), 64) // COLUMNS)
    page = style.Page(2 * MARGIN + COLUMNS * CELL[0],
                      HEAD + upper + 6 + sheet_rows * CELL[1] + 8)
    page.text(MARGIN, 4, "The dataset", fontsize=12, weight="bold")
    page.text(MARGIN, 11, f"{table.count} fabrics, {int(table.converged.sum())} with a certified "
                          "drape; types, fibres and weights by the tag model", fontsize=7.5)
    categories(page, table)
    types(page, MARGIN, HEAD, 98, table)
    fibres(page, MARGIN + 102, HEAD, 90, table)
    right = MARGIN + 206
    weight_and_bending(page, right, HEAD, 82, chart, table)
    photographs = measured("cusick_photos_noise_floor.csv")
    solved = table.converged
    histogram(page, right, HEAD + chart, 46, chart, "Drape coefficient, %",
              100 * table.drape_coefficient[solved], np.arange(0, 105, 5),
              [float(row["dc_mean_pct"]) for row in photographs])
    histogram(page, right + 52, HEAD + chart, 30, chart, "Nodes", table.nodes[solved],
              np.arange(-0.5, max(20, table.nodes.max() + 2)),
              [float(row["nodes_mean"]) for row in photographs])
    if photographs:
        page.text(right, HEAD + chart + 4, "|  means of photographed fabrics (Gong et al. 2024)",
                  fontsize=6, color=style.WARNING)
    contact_sheet(page, HEAD + upper + 4, table)
    page.text(MARGIN, page.height - 5,
              "Drapes seen from above, weft to the right; colours: category. "
              f"Drape, commit {table.git_commit[:12]}", fontsize=6, color="#666666")
    return page


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", help="a results.h5 of kind dataset")
    parser.add_argument("--out", required=True, help="path of the picture without its suffix")
    arguments = parser.parse_args()
    try:
        table = read(arguments.results)
    except (OSError, KeyError) as error:
        print(f"{arguments.results}: cannot be read as drape-records: {error}", file=sys.stderr)
        sys.exit(2)
    for file in picture(table).save(arguments.out):
        print(file)


if __name__ == "__main__":
    main()
