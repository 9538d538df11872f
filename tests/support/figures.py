"""What the tests of figures share: a made-up table of records, and what a page must be like."""

import subprocess
import sys
import tempfile
import unittest
from itertools import combinations
from pathlib import Path

import h5py
import numpy as np

FIGURES = Path(__file__).resolve().parents[2] / "experiments" / "figures"
sys.path.insert(0, str(FIGURES))

import style  # noqa: E402

SUPPORT, SPECIMEN = 0.09, 0.15
PARAMETERS = ["areal_density", "k_u", "k_v", "k_h", "k_bu", "k_bv", "k_bh", "s_bu", "s_bv", "s_bh",
              "t_bu", "t_bv", "t_bh"]
TAGS = [
    ("Animal alternatives", "Vegan leather", "Vegan leather", "Spandex / Elastane 100"),
    ("Cut & Sew knit", "Double", "Double knit / Interlock",
     "Polyester 68; Spandex / Elastane 2; Viscose rayon 25; Cotton 3; Linen 1; Other fibres 1"),
    ("", "", "", ""),
]


def annulus(vertices):
    """Rest positions from just inside of the clamp to the rim, and triangles."""
    inner = 0.95 * SUPPORT
    index = np.arange(vertices) + 0.5
    radius = np.sqrt(inner**2 + (SPECIMEN**2 - inner**2) * index / vertices)
    angle = np.pi * (3 - np.sqrt(5)) * index
    uv = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    triangles = style.Triangulation(*uv.T).triangles
    return uv, triangles[np.linalg.norm(uv[triangles].mean(axis=1), axis=1) > inner].astype(np.int32)


def profile(share, folds, depth):
    angle = np.radians(np.arange(360))
    return SUPPORT + (SPECIMEN - SUPPORT) * np.clip(share + depth * np.cos(folds * angle), 0.1, 0.98)


def drape(uv, share, folds, depth):
    """Every meridian hangs in a circular arc that ends at the profile."""
    radius, angle = np.linalg.norm(uv, axis=1), np.arctan2(uv[:, 1], uv[:, 0])
    wanted = np.clip(share + depth * np.cos(folds * angle), 0.1, 0.98)
    bend = np.linspace(1e-3, np.pi, 2000)
    total = np.interp(-wanted, -np.sin(bend) / bend, bend)
    overhang = np.maximum(radius - SUPPORT, 0)
    curvature = total / (SPECIMEN - SUPPORT)
    out = np.minimum(radius, SUPPORT) + np.sin(curvature * overhang) / curvature
    down = -(1 - np.cos(curvature * overhang)) / curvature
    return np.stack([out * np.cos(angle), out * np.sin(angle), down], axis=1)


def write(path, count, vertices=600, outcomes=("succeeded",), status="converged"):
    """A results.h5 of `count` fabrics; outcomes are taken in turn, "" stands for no estimate."""
    uv, triangles = annulus(vertices)
    shapes = [(0.85 - 0.6 * i / max(count, 2), 3 + i % 6, 0.1) for i in range(count)]
    outcome = [outcomes[i % len(outcomes)] for i in range(count)]
    with h5py.File(path, "w") as file:
        file.attrs.update(support_radius=SUPPORT, specimen_radius=SPECIMEN, git_commit="0" * 40)
        file["mesh/disc/rest_uv"], file["mesh/disc/triangles"] = uv, triangles
        for i, name in enumerate(["category", "subcategory", "type", "composition"]):
            file[f"fabric/{name}"] = [TAGS[j % len(TAGS)][i] for j in range(count)]
        file["fabric/id"] = [chr(ord("A") + i % 26) for i in range(count)]
        file["fabric/name"] = [f"fabric {i}" for i in range(count)]
        for i, name in enumerate(PARAMETERS):
            true = 1e-6 * 1.7 ** np.arange(count) if name.startswith("k_b") else np.full(count, 60.0)
            file[f"params/{name}"] = true if i else np.full(count, 0.2)
            file[f"params_start/{name}"] = 2 * true
            file[f"params_estimated/{name}"] = true * (1.004 if i % 2 else 0.25)
            file[f"params_estimated_log_sd/{name}"] = np.full(count, 0.1 if i % 2 else np.nan)
        states = np.array([drape(uv, *shape) for shape in shapes])
        if status != "converged":
            states[-1] = np.nan
        file["sim/positions"] = states
        file["sim"].attrs["mesh"] = "disc"
        file["sim_estimated/positions"] = states
        file["stats/status"] = ["converged"] * (count - 1) + [status]
        file["stats/energy"] = -1e-3 + 2e-5 * np.arange(count)
        profiles = np.array([profile(*shape) for shape in shapes])
        file["observation/profile"] = profiles
        file["observation/coverage"] = np.zeros((count, 4, 4), np.uint16)
        file["observation/drape_coefficient"] = [shape[0] for shape in shapes]
        file["observation/node_count"] = [shape[1] for shape in shapes]
        file["estimate/outcome"] = outcome
        file["estimate/branch_shared"] = np.array([o == "succeeded" for o in outcome], np.uint8)
        file["estimate/profile"] = profiles + 2e-4
        file["estimate/start_profile"] = 0.3 * SPECIMEN + 0.7 * profiles
        file["estimate/outline_rms"] = 2e-9 * 1e2 ** (np.arange(count) % 4)
        file["estimate/iou"] = np.full(count, 0.987)
        file["estimate/drape_coefficient"] = [shape[0] for shape in shapes]
        file["estimate/node_count"] = [shape[1] for shape in shapes]


def texts(page):
    """The texts of a page with their boxes in pixels."""
    page.figure.canvas.draw()
    found = list(page.figure.texts)
    for axes in page.figure.axes:
        found += axes.texts + [axes.title]
        for axis in (axes.xaxis, axes.yaxis) if axes.axison else ():
            low, high = sorted(axis.get_view_interval())
            found += [tick.label1 for tick in axis.get_major_ticks() + axis.get_minor_ticks()
                      if low <= tick.get_loc() <= high]  # others exist and are not drawn
    return [(text, text.get_window_extent()) for text in found if text.get_text().strip()]


class FigureTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(style.plt.close, "all")
        self.folder = Path(folder.name)
        self.file = self.folder / "results.h5"

    def check_layout(self, page):
        """Texts are inside of the page, apart from each other and at least 6 points high."""
        found = texts(page)
        self.assertGreater(len(found), 10)
        sheet = page.figure.bbox
        for text, box in found:
            self.assertGreaterEqual(text.get_fontsize(), 6, text.get_text())
            self.assertTrue(sheet.x0 <= box.x0 and box.x1 <= sheet.x1 and sheet.y0 <= box.y0 and
                            box.y1 <= sheet.y1, f"{text.get_text()!r} leaves the page")
        for (one, box), (other, other_box) in combinations(found, 2):
            self.assertFalse(box.overlaps(other_box), f"{one.get_text()!r} on {other.get_text()!r}")

    def words(self, page):
        return " ".join(text.get_text().replace("\n", " ") for text, _ in texts(page))

    def run_script(self, name, *arguments):
        return subprocess.run(["/usr/bin/python3", "-B", FIGURES / name, *arguments],
                              capture_output=True, text=True)
