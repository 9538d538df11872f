#!/usr/bin/python3
"""Are two tables of records the same in every dataset and attribute but times and provenance?

    /usr/bin/python3 same_records.py ONE.h5 OTHER.h5    exits 1 and says where they differ
"""

import sys

import h5py
import numpy as np

TIMES = {"stats/cpu_seconds"}
PROVENANCE = {"config", "git_commit", "compiler"}


def values(node):
    """What a file holds at a path: attributes, and the data of a dataset."""
    held = {f"@{name}": value for name, value in node.attrs.items() if name not in PROVENANCE}
    if isinstance(node, h5py.Dataset):
        held["data"] = node.asstr()[...] if h5py.check_string_dtype(node.dtype) else node[...]
        held["type"] = str(node.dtype)
    return held


def content(path):
    """path -> values, of everything in a file."""
    with h5py.File(path, "r") as file:
        found = {"/": values(file)}
        file.visititems(lambda name, node: found.update({name: values(node)}))
    return {name: held for name, held in found.items() if name not in TIMES}


def same(one, other):
    one, other = np.asarray(one), np.asarray(other)
    floats = one.dtype.kind == "f" and other.dtype.kind == "f"
    return np.array_equal(one, other, equal_nan=floats)


def differences(one, other):
    """Lines that say where two files differ."""
    a, b = content(one), content(other)
    found = [f"{name}: is in one file only" for name in sorted(a.keys() ^ b.keys())]
    for name in sorted(a.keys() & b.keys()):
        for part in sorted(a[name].keys() | b[name].keys()):
            if part not in a[name] or part not in b[name]:
                found.append(f"{name} {part}: is in one file only")
            elif not same(a[name][part], b[name][part]):
                found.append(f"{name} {part}: differs")
    return found


def main():
    found = differences(*sys.argv[1:3])
    print("\n".join(found) or f"the same: {len(content(sys.argv[1]))} groups and datasets")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
