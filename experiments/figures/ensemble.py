#!/usr/bin/python3
"""The distinct drapes of one fabric: energy against drape coefficient, each with its outline.

    /usr/bin/python3 ensemble.py RESULTS.h5 --out DIR/ensemble     writes ensemble.png and ensemble.pdf
"""

import numpy as np

import results as records
import style

WIDTH, HEIGHT = 180, 129  # mm
PLOT = (18, 16, 156, 96)  # left, top, width, height [mm]
COLOURS = {3: "#56B4E9", 4: "#0072B2", 5: "#009E73", 6: "#E69F00", 7: "#D55E00", 8: "#CC79A7",
           9: "#222222"}
SIZE = 11  # of an outline [mm]


def picture(results):
    page = style.Page(WIDTH, HEIGHT)
    minima = results.records
    coefficient = np.array([100 * record.drape_coefficient for record in minima])
    energy = np.array([1e3 * record.energy for record in minima])
    found = np.array([len(record.tag["name"].split("; ")) for record in minima])
    page.text(PLOT[0], 4, "The drapes of one fabric", fontsize=11, weight="bold")
    page.text(PLOT[0], 10, f"{found.sum()} starts end in {len(minima)} distinct minima; drape "
              f"coefficient {coefficient.min():.1f} to {coefficient.max():.1f} %", fontsize=7.5)
    axes = page.axes(*PLOT)
    axes.set_xlabel("drape coefficient [%]")
    axes.set_ylabel("energy [mJ]")
    span = np.ptp(coefficient) or 1, np.ptp(energy) or 1
    axes.set_xlim(coefficient.min() - 0.12 * span[0], coefficient.max() + 0.12 * span[0])
    axes.set_ylim(energy.min() - 0.12 * span[1], energy.max() + 0.12 * span[1])
    anchors = np.stack([axes.transAxes.inverted().transform(axes.transData.transform(point))
                        for point in zip(coefficient, energy)]) * [PLOT[2], PLOT[3]]
    centres = spread(anchors)
    for record, anchor, centre, times in zip(minima, anchors, centres, found):
        colour = COLOURS.get(record.node_count, "#666666")
        axes.plot(*(np.stack([anchor, centre]) / [PLOT[2], PLOT[3]]).T, transform=axes.transAxes,
                  color=style.FAINT, linewidth=0.4, zorder=0)
        axes.plot(*(anchor / [PLOT[2], PLOT[3]]), transform=axes.transAxes, marker="o",
                  markersize=1.5 + times, color=colour, markeredgewidth=0)
        outline(axes, centre, record.profile / results.specimen_radius, colour)
    for i, nodes in enumerate(sorted({record.node_count for record in minima}, reverse=True)):
        page.text(WIDTH - 8 - 15 * i, 5, f"{nodes} nodes", ha="right", fontsize=7,
                  color=COLOURS.get(nodes, "#666666"), weight="bold")
    page.text(PLOT[0], HEIGHT - 5, "Dots: minima, larger where more starts ended there. Outlines "
              f"seen from above, weft to the right. Drape, commit {results.git_commit[:12]}",
              fontsize=6, color="#666666")
    return page


def spread(anchors):
    """Centres of the outlines in mm: near their dots, beside each other, inside of the plot."""
    centres = anchors + [0.55 * SIZE, 0.55 * SIZE]
    for _ in range(400):
        gap = centres[:, None] - centres[None]
        distance = np.linalg.norm(gap, axis=2) + 1e-9
        push = np.where(distance < 1.05 * SIZE, (1.05 * SIZE - distance) / distance, 0)
        np.fill_diagonal(push, 0)
        centres = centres + 0.3 * (push[:, :, None] * gap).sum(axis=1)
        off = centres[:, None] - anchors[None]  # outlines keep clear of the dots as well
        distance = np.linalg.norm(off, axis=2) + 1e-9
        push = np.where(distance < 0.6 * SIZE, (0.6 * SIZE - distance) / distance, 0)
        centres = centres + 0.3 * (push[:, :, None] * off).sum(axis=1)
        centres += 0.02 * (anchors - centres)
        centres = np.clip(centres, SIZE / 2, np.array([PLOT[2], PLOT[3]]) - SIZE / 2)
    return centres


def outline(axes, centre, radius, colour):
    angle = np.radians(np.arange(len(radius) + 1) * 360 / len(radius))
    closed = SIZE / 2 * np.append(radius, radius[0])
    points = (centre + np.stack([closed * np.cos(angle), closed * np.sin(angle)], axis=1))
    axes.fill(*(points / [PLOT[2], PLOT[3]]).T, transform=axes.transAxes, facecolor="white",
              edgecolor=colour, linewidth=0.7, zorder=3)


if __name__ == "__main__":
    records.draw("a run of kind drape with an ensemble", __doc__, picture)
