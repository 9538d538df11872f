"""Reads a results.h5 (schema drape-records) for the figures. Lengths stay in metres."""

import sys
from dataclasses import dataclass, field

import h5py
import numpy as np

import command_line


@dataclass
class Estimate:
    outcome: str
    branch_shared: bool
    start: dict  # parameter name -> value
    parameters: dict
    log_sd: dict  # NaN where a parameter was held
    positions: np.ndarray
    profile: np.ndarray
    start_profile: np.ndarray
    weft_angle: float  # in the picture, from +x
    rigidity: np.ndarray  # effective B_u, B_v, B_45; NaN in files of version 2 and older
    rigidity_log_sd: np.ndarray
    outline_rms: float
    iou: float
    drape_coefficient: float
    node_count: int

    @property
    def succeeded(self):
        return self.outcome == "succeeded"


@dataclass
class Record:
    id: str
    tag: dict  # name, category, subcategory, type, composition; empty texts where unknown
    status: str
    parameters: dict
    positions: np.ndarray  # [nv, 3]; NaN where the solve failed
    profile: np.ndarray  # [360]
    drape_coefficient: float
    node_count: int
    energy: float  # NaN where the solve failed
    estimate: Estimate | None


@dataclass
class Results:
    support_radius: float
    specimen_radius: float
    git_commit: str
    rest_uv: np.ndarray
    triangles: np.ndarray
    records: list = field(default_factory=list)


def draw(content, description, page):
    """Command line of a figure: reads a results.h5 of `content` and saves page(results).

    Ends with exit code 2 where the file cannot be read, or holds what page refuses (ValueError).
    """
    command_line.draw("results", f"results.h5 of {content}", description,
                      lambda path: page(read(path)))


def read(path):
    """All of a file. Exits with code 2 and one line where that is impossible."""
    try:
        with h5py.File(path, "r") as file:
            return _results(file)
    except (OSError, KeyError) as error:
        print(f"{path}: cannot be read as drape-records: {error}", file=sys.stderr)
        sys.exit(2)


def _results(file):
    columns = {}
    file.visititems(lambda name, item: columns.update(_column(name, item)))
    mesh = f"mesh/{_text(file['sim'].attrs['mesh'])}"
    results = Results(
        support_radius=float(file.attrs["support_radius"]),
        specimen_radius=float(file.attrs["specimen_radius"]),
        git_commit=_text(file.attrs["git_commit"]),
        rest_uv=columns[f"{mesh}/rest_uv"],
        triangles=columns[f"{mesh}/triangles"],
    )
    for row in range(len(columns["fabric/id"])):
        results.records.append(_record({name: column[row] for name, column in columns.items()
                                        if not name.startswith("mesh/")}))
    return results


def _column(name, item):
    # The coverage images are large and no figure needs them.
    if not isinstance(item, h5py.Dataset) or name == "observation/coverage":
        return {}
    return {name: item.asstr()[...] if h5py.check_string_dtype(item.dtype) else item[...]}


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _group(row, group):
    prefix = group + "/"
    return {name.removeprefix(prefix): value for name, value in row.items()
            if name.startswith(prefix)}


def _record(row):
    tag = _group(row, "fabric")
    return Record(
        id=tag.pop("id"),
        tag=tag,
        status=row["stats/status"],
        parameters=_group(row, "params"),
        positions=row["sim/positions"],
        profile=row["observation/profile"],
        drape_coefficient=float(row["observation/drape_coefficient"]),
        node_count=int(row["observation/node_count"]),
        energy=float(row["stats/energy"]),
        estimate=_estimate(row) if row.get("estimate/outcome") else None,
    )


def _estimate(row):
    return Estimate(
        outcome=row["estimate/outcome"],
        branch_shared=bool(row["estimate/branch_shared"]),
        start=_group(row, "params_start"),
        parameters=_group(row, "params_estimated"),
        log_sd=_group(row, "params_estimated_log_sd"),
        positions=row["sim_estimated/positions"],
        profile=row["estimate/profile"],
        start_profile=row["estimate/start_profile"],
        weft_angle=float(row.get("estimate/weft_angle", 0)),
        rigidity=row.get("estimate/effective_rigidity", np.full(3, np.nan)),
        rigidity_log_sd=row.get("estimate/effective_rigidity_log_sd", np.full(3, np.nan)),
        outline_rms=float(row["estimate/outline_rms"]),
        iou=float(row["estimate/iou"]),
        drape_coefficient=float(row["estimate/drape_coefficient"]),
        node_count=int(row["estimate/node_count"]),
    )
