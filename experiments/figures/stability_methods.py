#!/usr/bin/python3
"""What became of every method in the atlas, and why methods of its kind fail where they fail.

    /usr/bin/python3 stability_methods.py ATLAS.json --out DIR/methods    writes .png and .pdf"""
import textwrap

from matplotlib.patches import Rectangle

import stability
import study
import style

WIDTH, LEFT, LABEL, TOP = 182, 6, 40, 21
LINE, GAP, BAR = 2.9, 4, 3.4  # of text, between methods, height of a bar
COLUMNS = 112  # characters of a line


def page(atlas):
    methods = {name: paragraph(account) for name, account in atlas["methods"].items()}
    height = sum(block(lines) for lines in methods.values())
    figure = style.Page(WIDTH, TOP + height + 12)
    figure.text(LEFT, 4, "Where methods converge, and why they fail", fontsize=11, weight="bold")
    figure.text(LEFT, 10.5,
                f"Runs of the atlas, {atlas['cpu_seconds']:g} s of CPU at 1000 vertices. Counts by "
                "vertices, ratio and density are of the map with the method's own time step.\n"
                "Bars: the shares of outcomes. First what was measured; in grey the mechanism, and "
                "who describes it.", linespacing=1.3)
    top = TOP
    for name, lines in methods.items():
        account = atlas["methods"][name]
        figure.text(LEFT, top, account["label"], weight="bold", fontsize=6.5)
        bar(figure, top + 4, account["outcomes"])
        for i, (line, colour) in enumerate(lines):
            figure.text(LEFT + LABEL, top + LINE * i, line, fontsize=6.2, color=colour)
        top += block(lines)
    stability.legend(figure, top)
    return figure


def paragraph(account):
    """The lines of a method and their colours."""
    return [(line, colour) for part, colour in (("measured", "black"), ("limits", "#666666"))
            for line in textwrap.wrap(account[part].replace(" at ", "\u00a0at\u00a0"), COLUMNS)]


def block(lines):
    return max(LINE * len(lines), 4 + BAR) + GAP


def bar(figure, top, outcomes):
    axes = figure.axes(LEFT, top, LABEL - 6, BAR)
    axes.set(xlim=(0, sum(outcomes.values())), ylim=(0, 1))
    axes.axis("off")
    left = 0
    for outcome, (colour, _) in stability.OUTCOMES.items():
        axes.add_patch(Rectangle((left, 0), outcomes.get(outcome, 0), 1, facecolor=colour))
        left += outcomes.get(outcome, 0)


if __name__ == "__main__":
    study.draw("stability", __doc__, page)
