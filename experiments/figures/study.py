"""What the figures of studies share: they draw the summary of a run."""
import argparse
import json
import sys

from matplotlib.ticker import LogLocator, NullLocator


def few_ticks(axis):
    """Ticks of a logarithmic axis that spans little, as plain numbers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_locator(NullLocator())


def draw(kind, description, page):
    """Command line of a figure: reads a summary of `kind` and saves page(summary).

    Ends with exit code 2 where the file cannot be read as such a summary.
    """
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("summary", help=f"summary.json of a run of kind {kind}")
    parser.add_argument("--out", required=True, help="path and stem of the files to write")
    arguments = parser.parse_args()
    try:
        with open(arguments.summary, encoding="utf-8") as file:
            summary = json.load(file)
        drawn = page(summary)
    except (OSError, ValueError, KeyError) as error:
        print(f"{arguments.summary}: cannot be read as a summary of kind {kind}: {error!r}",
              file=sys.stderr)
        sys.exit(2)
    for path in drawn.save(arguments.out):
        print(path)
