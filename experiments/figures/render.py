#!/usr/bin/python3
"""Drapes in light and shadow, rendered by POV-Ray: up to six records of a table, from limp to stiff.

    /usr/bin/python3 render.py RESULTS.h5 --out DIR/renders     writes renders.png and renders.pdf
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.image
import numpy as np

import results as records
import style

PIXELS = (900, 640)  # of one drape
COLUMNS, ROWS = 3, 2
PANEL_WIDTH = 60  # mm
PANEL_HEIGHT = PANEL_WIDTH * PIXELS[1] / PIXELS[0]
MARGIN, HEAD, CAPTION, FOOT = 5, 11, 9, 7
PEDESTAL = 160  # mm, from the support's edge to the table
PENETRATION = 2  # mm that the column is drawn thinner: contact is a penalty, cloth enters a little

SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1.0 }}
background {{ color rgb <0.93, 0.94, 0.95> }}
camera {{
  location <-430, 300, -560> right x*{aspect} angle 28 look_at <0, -50, 0>
}}
light_source {{
  <-800, 620, -60> color rgb 1.15
  area_light <220, 0, 0>, <0, 0, 220>, 7, 7 adaptive 1 jitter circular orient
}}
light_source {{ <600, 400, -500> color rgb 0.22 shadowless }}
plane {{ y, -{pedestal} pigment {{ rgb <0.80, 0.81, 0.83> }} finish {{ ambient 0.12 diffuse 0.75 }} }}
cylinder {{
  <0, -{pedestal}, 0>, <0, -0.6, 0>, {column}
  pigment {{ rgb <0.45, 0.46, 0.48> }} finish {{ ambient 0.1 diffuse 0.6 }}
}}
#declare Cloth = texture {{
  pigment {{ rgb <{colour}> }} finish {{ ambient 0.14 diffuse 0.75 specular 0.05 roughness 0.2 }}
}}
disc {{ <0, 0, 0>, y, {support} texture {{ Cloth }} }}
mesh2 {{
  vertex_vectors {{ {count}, {points} }}
  normal_vectors {{ {count}, {normals} }}
  face_indices {{ {faces}, {triangles} }}
  texture {{ Cloth }}
}}
"""


def chosen(results):
    """Up to six converged records, equally spaced in the order of their drape coefficients."""
    solved = [record for record in results.records if np.isfinite(record.positions).all()]
    solved.sort(key=lambda record: record.drape_coefficient)
    count = min(len(solved), COLUMNS * ROWS)
    return [solved[round(i * (len(solved) - 1) / max(count - 1, 1))] for i in range(count)]


def scene(results, positions, colour):
    """The drape as a scene of POV-Ray: millimetres, y up."""
    points = 1e3 * positions[:, [0, 2, 1]]
    triangles = results.triangles
    normals = style.vertex_normals(points, triangles)
    return SCENE.format(
        aspect=PIXELS[0] / PIXELS[1], pedestal=PEDESTAL, support=1e3 * results.support_radius,
        column=1e3 * results.support_radius - PENETRATION,
        colour=", ".join(f"{c ** 2.2:.3f}" for c in colour), count=len(points), faces=len(triangles),
        points=vectors(points), normals=vectors(normals), triangles=vectors(triangles, "d"))


def vectors(rows, kind=".4f"):
    return ", ".join("<" + ", ".join(format(value, kind) for value in row) + ">" for row in rows)


def rendered(text):
    """The picture of a scene. Ends with exit code 2 without POV-Ray and 1 where it fails."""
    if shutil.which("povray") is None:
        print("POV-Ray (Debian package povray) is not installed", file=sys.stderr)
        sys.exit(2)
    with tempfile.TemporaryDirectory() as folder:
        source, picture = Path(folder) / "drape.pov", Path(folder) / "drape.png"
        source.write_text(text, encoding="ascii")
        run = subprocess.run(
            ["povray", f"+I{source}", f"+O{picture}", f"+W{PIXELS[0]}", f"+H{PIXELS[1]}", "+A0.2",
             "-D", "+WT1"], capture_output=True, text=True, check=False)
        if run.returncode != 0 or not picture.exists():
            print(f"POV-Ray failed:\n{run.stderr[-2000:]}", file=sys.stderr)
            sys.exit(1)
        return matplotlib.image.imread(picture)


def caption(record):
    label = record.tag.get("type") or record.tag.get("name") or f"record {record.id}"
    return (f"{label}\nDC {style.percent(record.drape_coefficient)}, "
            f"{record.node_count} nodes, {1e3 * record.parameters['areal_density']:.0f} g/m²")


def page_of(results):
    """The page with the rendered drapes."""
    drapes = chosen(results)
    rows = max(-(-len(drapes) // COLUMNS), 1)
    page = style.Page(2 * MARGIN + COLUMNS * PANEL_WIDTH,
                      HEAD + rows * (PANEL_HEIGHT + CAPTION) + FOOT)
    page.text(MARGIN, 4, "Drapes at equilibrium, from limp to stiff", fontsize=10, weight="bold")
    for i, record in enumerate(drapes):
        left = MARGIN + i % COLUMNS * PANEL_WIDTH
        top = HEAD + i // COLUMNS * (PANEL_HEIGHT + CAPTION)
        colour = matplotlib.colors.to_rgb(style.FABRICS[i % len(style.FABRICS)])
        axes = page.axes(left, top, PANEL_WIDTH - 2, PANEL_HEIGHT)
        axes.imshow(rendered(scene(results, record.positions, colour)), interpolation="none")
        axes.axis("off")
        page.text(left, top + PANEL_HEIGHT + 0.8, caption(record), linespacing=1.3)
    page.text(MARGIN, page.height - 4.5,
              f"Support {2e3 * results.support_radius:.0f} mm, specimen "
              f"{2e3 * results.specimen_radius:.0f} mm across. DC: drape coefficient. Rendered by "
              f"POV-Ray. Drape, commit {results.git_commit[:12]}", fontsize=6, color="#666666")
    return page


if __name__ == "__main__":
    records.draw("a run", __doc__, page_of)
