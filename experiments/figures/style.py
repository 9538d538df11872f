"""The common look of the figures: colours, type, and how a drape and its outlines are drawn."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import TriMesh
from matplotlib.colors import LinearSegmentedColormap, to_rgb
from matplotlib.patches import Circle
from matplotlib.tri import Triangulation

MM_PER_INCH = 25.4
DPI = 200  # of the PNG and of the shaded drapes inside of the PDF

# Okabe and Ito's palette: told apart by colour-blind readers and in grey.
TARGET = "#222222"
START = "#E69F00"
ESTIMATE = "#0072B2"
WARNING = "#C23B00"
FAINT = "#B5B5B5"

FABRICS = ["#8FA3B8", "#B89E8A", "#9DB39B", "#B59BAF", "#B8AF86"]

# Parameters in tables: symbol, unit as printed, and what one SI unit is in it.
PARAMETERS = {
    "k_bu": ("$k_{bu}$", "µN m", 1e6),
    "k_bv": ("$k_{bv}$", "µN m", 1e6),
    "k_bh": ("$k_{bh}$", "µN m", 1e6),
    "k_h": ("$k_h$", "N/m", 1),
}

OUTLINES = {  # label -> line, from the bottom up
    "target": dict(color=TARGET, linewidth=2.4, alpha=0.35),
    "start": dict(color=START, linewidth=0.9, dashes=(4, 2)),
    "estimate": dict(color=ESTIMATE, linewidth=0.9),
}

plt.rcParams.update({
    "font.family": "DejaVu Sans",
    "font.size": 7,
    "axes.linewidth": 0.5,
    "axes.edgecolor": FAINT,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.major.size": 2,
    "ytick.major.size": 2,
    "xtick.labelsize": 6,
    "ytick.labelsize": 6,
    "pdf.fonttype": 42,
    "savefig.facecolor": "white",
})


class Page:
    """A figure measured in millimetres from its upper left corner."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.figure = plt.figure(figsize=(width / MM_PER_INCH, height / MM_PER_INCH), dpi=DPI)

    def axes(self, left, top, width, height):
        return self.figure.add_axes((left / self.width, 1 - (top + height) / self.height,
                                     width / self.width, height / self.height))

    def text(self, left, top, text, **options):
        """`top` is the upper end of the text, or its baseline with va="baseline"."""
        options.setdefault("va", "top")
        return self.figure.text(left / self.width, 1 - top / self.height, text, **options)

    def legend(self, left, top):
        """The three kinds of outline, in one row."""
        axes = self.axes(left, top, 66, 5)
        axes.set(xlim=(0, 66), ylim=(0, 5))
        axes.axis("off")
        for i, (label, line) in enumerate(OUTLINES.items()):
            axes.plot([22 * i, 22 * i + 7], [2.5, 2.5], **line)
            axes.text(22 * i + 8.5, 2.5, label, va="center")

    def save(self, stem):
        """Writes stem.png and stem.pdf and returns both paths."""
        stem = Path(stem)
        stem.parent.mkdir(parents=True, exist_ok=True)
        files = [stem.with_name(stem.name + suffix) for suffix in (".png", ".pdf")]
        for file in files:
            self.figure.savefig(file, dpi=DPI)
        plt.close(self.figure)
        return files


def number(value):
    """Three significant digits."""
    text = f"{value:#.3g}" if abs(value) < 999.5 else f"{float(f'{value:.3g}'):.0f}"
    return text.rstrip(".").replace("-", "−")


def change(value, reference):
    """The relative difference of two positive numbers in words."""
    ratio = value / reference
    return f"{100 * (ratio - 1):+.1f} %".replace("-", "−") if ratio < 10 else f"× {number(ratio)}"


def millimetres(metres):
    return "< 0.001 mm" if metres < 1e-6 else f"{number(1e3 * metres)} mm"


def percent(fraction):
    return f"{100 * fraction:.1f} %"


def draw_drape(axes, results, positions, colour):
    """The drape from above (weft to the right), lit from the upper left; x, y in millimetres."""
    points = 1e3 * positions
    triangles = results.triangles
    corners = points[triangles]
    # Painter's order: what is higher hides what is lower.
    triangles = triangles[np.argsort(corners[:, :, 2].mean(axis=1))]
    axes.add_collection(TriMesh(Triangulation(points[:, 0], points[:, 1], triangles),
                                array=_brightness(points, triangles), cmap=_shades(colour),
                                norm=plt.Normalize(0, 1), rasterized=True))
    # The mesh begins just inside of the clamp: the flat rest of the specimen lies on the support.
    flat = _shades(colour)(_lit(np.array([[0.0, 0.0, 1.0]]))[0])
    axes.add_patch(Circle((0, 0), 1e3 * results.support_radius, facecolor=flat,
                          edgecolor=(0, 0, 0, 0.35), linewidth=0.4, rasterized=True))
    _frame(axes, results)
    axes.axis("off")


def draw_outlines(axes, results, profiles):
    """`profiles`: label of OUTLINES -> radii [m] at equal steps counter-clockwise from the weft."""
    for radius in (results.support_radius, results.specimen_radius):
        axes.add_patch(Circle((0, 0), 1e3 * radius, fill=False, edgecolor=FAINT, linewidth=0.4))
    for label, line in OUTLINES.items():
        if label in profiles:
            radius = 1e3 * np.append(profiles[label], profiles[label][0])
            angle = np.linspace(0, 2 * np.pi, len(radius))
            axes.plot(radius * np.cos(angle), radius * np.sin(angle), **line)
    _frame(axes, results)
    ticks = 1e3 * results.support_radius * np.array([-1, 0, 1])
    axes.set_xticks(ticks)
    axes.set_yticks(ticks)
    axes.tick_params(pad=1.5, color=FAINT)


def _frame(axes, results):
    half = 1.04e3 * results.specimen_radius
    axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal")


def _shades(colour):
    rgb = np.array(to_rgb(colour))
    return LinearSegmentedColormap.from_list("cloth", [0.22 * rgb, rgb, 0.35 * rgb + 0.65])


def _lit(normals):
    """Lambert's cosine law with some ambient light, in [0, 1]."""
    light = np.array([-0.55, 0.55, 0.63])
    return 0.15 + 0.85 * np.clip(normals @ (light / np.linalg.norm(light)), 0, 1)


def vertex_normals(points, triangles):
    """Unit normals, one a vertex: those of its triangles weighted by area."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals = np.zeros_like(points)
    for i in range(3):
        np.add.at(normals, triangles[:, i], np.cross(b - a, c - a))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def _brightness(points, triangles):
    """One value a vertex. Deep parts get less of the ambient light."""
    normals = vertex_normals(points, triangles)
    normals *= np.where(normals[:, 2:] < 0, -1, 1)  # the side that is seen
    depth = points[:, 2] / min(points[:, 2].min(), -1e-9)
    return _lit(normals) * (1 - 0.3 * np.clip(depth, 0, 1))
