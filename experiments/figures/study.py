"""What the figures of studies share: they draw the summary of a run."""
import json

from matplotlib.ticker import LogLocator, NullLocator

import command_line


def few_ticks(axis):
    """Ticks of a logarithmic axis that spans little, as plain numbers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_locator(NullLocator())


def draw(kind, description, page):
    """Command line of a figure: reads a summary of `kind` and saves page(summary).

    Ends with exit code 2 where the file cannot be read as such a summary.
    """
    def drawn(path):
        try:
            with open(path, encoding="utf-8") as file:
                return page(json.load(file))
        except (OSError, ValueError, KeyError) as error:
            raise ValueError(f"cannot be read as a summary of kind {kind}: {error!r}") from error

    command_line.draw("summary", f"summary.json of a run of kind {kind}", description, drawn)
