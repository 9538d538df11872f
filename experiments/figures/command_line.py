"""The command line that the figures of one file share."""
import argparse
import sys


def draw(argument, content, description, page):
    """Reads the path of a file and saves page(path).

    Ends with exit code 2 where the file is not one to draw, which page says by ValueError.
    """
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(argument, help=content)
    parser.add_argument("--out", required=True, help="path and stem of the files to write")
    arguments = vars(parser.parse_args())
    try:
        drawn = page(arguments[argument])
    except ValueError as error:
        print(f"{arguments[argument]}: {error}", file=sys.stderr)
        sys.exit(2)
    for path in drawn.save(arguments["out"]):
        print(path)
