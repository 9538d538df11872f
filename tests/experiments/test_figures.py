#!/usr/bin/python3
"""The figure scripts on made-up results: they write what they promise, say failures in words, and no
two texts of a page overlap."""

import json
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

import ablation  # noqa: E402
import accuracy  # noqa: E402
import branches  # noqa: E402
import dataset  # noqa: E402
import drape_sheet  # noqa: E402
import ensemble  # noqa: E402
import estimation_precision  # noqa: E402
import estimate_overlay  # noqa: E402
import gradient_precision  # noqa: E402
import identifiability  # noqa: E402
import paper  # noqa: E402
import photographs  # noqa: E402
import recovery  # noqa: E402
import render  # noqa: E402
import results as records  # noqa: E402
import robustness  # noqa: E402
import snap_gradient  # noqa: E402
import stability  # noqa: E402
import tag_comparison  # noqa: E402
import style  # noqa: E402
import validation  # noqa: E402
import work_precision  # noqa: E402

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


def validation_summary():
    """What a run of kind validation writes, made up."""
    def rows(values, expected=0.01):
        return [{"value": value, "expected": expected * value, "mean_error": 0.01 * value,
                 "errors": [0.008 * value, 0.012 * value], "rigidity_over_k": 4.1 + 0.01 * i,
                 "mean_rigidity_over_k": 4.0} for i, value in enumerate(values)]
    studies = {"slenderness": rows([0.5, 1, 2]), "edge_length": rows([0.0015, 0.003, 0.006]),
               "width": rows([0.01, 0.02, 0.04]), "bent_direction": rows([0, 45, 90]),
               "hanging_direction": rows([0, 45, 90]),
               "hanging_far_stretched": rows([0, 45, 90], 1e-4),
               "plate": rows([500, 1000, 2000]),
               "plate_single_clamp_weight": rows([500, 1000, 2000])}
    bias = {f"{softness} anisotropic, {vertices}, {start}": {
        "mean": 57.123, "sd": 10.66, "sd_over_rotations": 10.67, "coherence_with_fabric": None,
        "coherence_with_mesh": 0.03, "nodes": {"10": 3, "6": 4, "7": 1}}
        for softness in ("stiff", "medium", "soft") for vertices in (1000, 2000)
        for start in ("lobes", "ramp")}
    return {"solves": 90, "converged": 89, "cantilever_order": 1.04, "plate_order": 2.1,
            "studies": studies, "mesh_bias": bias}


def accuracy_summary():
    """What a run of kind accuracy writes, made up; a soft fabric that no mesh follows."""
    def row(error, share):
        return {"error_median": error, "error_95": error and 2 * error,
                "same_nodes_error_median": 0.9, "matched_share": share, "cold_matched_share": 0,
                "cold_cpu_seconds_median": 1.3}
    return {"reference_vertices": 30000, "fabrics": 9, "per_softness": {
        "stiff": {"500": row(0.6, 1), "1000": row(0.3, 1)},
        "soft": {"500": row(None, 0), "1000": row(None, 0)}}}


METHODS = ["core", "projected_newton", "levenberg_marquardt", "lbfgs", "conjugate_gradients",
           "implicit_euler", "backward_euler", "explicit_dynamics", "dynamic_relaxation", "admm",
           "xpbd"]


def work_precision_chart(error="rms_mm"):
    """What a run of kind work_precision writes, made up; a run without a minimum to compare with."""
    def curve(i, method):
        low = [10, 1, 1e-3 if i else 0]
        return {"method": method, "label": "Newton, projected Hessian",
                "outcomes": ["converged", ["converged", "out_of_budget", "stalled"][i % 3]],
                "cpu_seconds": [0.001, 0.1, 1 + i], "low": low, "median": low,
                "high": [10, 2, None if method == "xpbd" else 1e-2]}
    return {"error": error, "panels": [
        {"start": start, "vertices": vertices, "fabric": fabric, "softness": softness,
         "budget_cpu_seconds": 3 * vertices / 1000, "seeds": 2,
         "curves": [curve(i, method) for i, method in enumerate(METHODS)]}
        for start in ("folded", "near") for vertices in (1000, 2000, 8000)
        for fabric, softness in enumerate(("stiff", "medium", "soft"))]}


def ablation_result():
    """What a run of kind ablation writes, made up: a fabric without a drape, cells of every kind."""
    names = [f"ingredient {i}" for i in range(16)]
    cells = []
    for i, name in enumerate(names):
        for fabric in range(6):
            cell = {"ingredient": name, "fabric": fabric, "status": "converged", "followed": i != 2,
                    "snaps": int(i == 3), "snap_change": 2.0 * (i == 3), "cpu_ratio": 0.5 + 0.1 * i,
                    "change": -0.004 * 3.0 ** (i % 8), "outline_rms": 1e-5 * 2.2 ** (i % 9),
                    "node_change": -1 if i == 4 else 0}
            cells.append({k: v for k, v in cell.items() if i != 5 or k not in
                          ("change", "outline_rms", "node_change")})
    rule = {"checked": 6, "acts_where_needed": 2, "idle_where_not_needed": 3, "acts_needlessly": 0,
            "idle_where_needed": 1}
    return {"vertices": 1000, "tolerance_points": 0.5, "outline_tolerance_mm": 1.0,
            "fabrics": [{"status": "converged", "drape_coefficient_percent": 15 * i + 10.0}
                        for i in range(6)] + [{"status": "no drape"}],
            "ingredients": [{"name": name, "label": "threshold read otherwise"} for name in names],
            "contact_rule": rule | {"cells": [{"penetration": 1e-4 * 4.0**i, "change": 0.01 * 3.0**i}
                                              for i in range(6)]},
            "resolution_rule": rule | {"cells": [
                {"status": "within_tolerance", "estimate": 0.1 * 2.0**i, "error": 0.03 * 2.0**i,
                 "same_branch": i > 0} for i in range(6)] + [{"status": "limited_by_solver"}]},
            "cells": cells}


def gradients_result():
    """Part of what a run of kind gradient_precision writes, made up."""
    rows = [{"method": method, "series": value, "setting": f"1e-0{i + 1}", "status": "converged",
             "error": 10.0 ** (-1 - 2 * i), "cpu_seconds": (i + 1) * scale,
             "memory_bytes": 1e6 * (i + 1)}
            for method, values, scale in (("adjoint", [0], 0.1), ("sensitivities", [0], 0.12),
                                          ("differences", [1e-4, 1e-6, 1e-8], 1.0),
                                          ("unrolled", [0.01, 0.1], 4.0))
            for value in values for i in range(4)]
    rows[-1] = {"method": "unrolled", "series": 0.1, "setting": "9", "status": "not solved"}
    rows[-2]["memory_bytes"] = None
    return {"reference_disagreement": 1e-8, "vertices": 1000, "parameters": 6, "rows": rows}


def snap_result():
    """The other part."""
    rows = [{"side": side, "distance": 10.0**-i, "status": "converged", "gradient": -10.0 * i,
             "smallest_eigenvalue": 1e-4 / i, "adjoint_error": 10.0 ** -(9 - i),
             "reference_uncertainty": 1e-9,
             "differences": [{"step": 1e-2, "error": 0.5}, {"step": 1e-4, "error": None}]}
            for side in ("before", "after") for i in range(1, 6)]
    rows.append({"side": "after", "distance": 0.3, "status": "the branch was lost"})
    return {"status": "found", "factor": 1.2345, "end": "limit_point", "rows": rows,
            "negative_eigenvalues_beyond": 1, "vertex_jump": 2e-3,
            "last_natural_step_distance": 1e-4}


def estimation_precision_chart():
    """What a run of kind estimation_precision writes, made up; one error is not known."""
    def curve(method, values):
        return {"method": method, "label": "Levenberg-Marquardt, differences",
                "cpu_seconds": [0.001, 0.1, 3], "low": values, "median": values, "high": values}
    errors = {"outline_mm": [3, 0.1, 0], "bending_error": [1, 0.2, None], "shear_error": [None] * 3}
    return {"fabrics": 3, "starts": 2, "fits": 6, "vertices": 500, "budget_cpu_seconds": 10,
            "curves": {error: [curve(method, values) for method in estimation_precision.LOOK]
                       for error, values in errors.items()}}


def stability_atlas():
    """What a run of kind stability writes, made up."""
    outcomes = list(stability.OUTCOMES)
    places = [("map", vertices, ratio, 0.2, step) for vertices in (250, 500)
              for ratio in (1e4, 1e5, 1e6, 1e7) for step in (0, 1e-4, 1e-2)]
    places += [("map", vertices, ratio, density, 0) for vertices in (250, 500)
               for ratio in (1e4, 1e5, 1e6, 1e7) for density in (0.05, 0.8)]
    places += [(case, 250, 0, 0, 0) for case in stability.CASES]
    cells = [dict(method=method, case=case, vertices=vertices, membrane_to_bending=ratio,
                  areal_density=density, time_step=step,
                  outcome=outcomes[(i + j) % len(outcomes)], smallest_residual=2e-6)
             for i, method in enumerate(METHODS)
             for j, (case, vertices, ratio, density, step) in enumerate(places)
             if not step or method in ("xpbd", "explicit_dynamics")]
    return {"cpu_seconds": 2, "cells": cells,
            "methods": {method: {"label": "implicit Euler, one solve"} for method in METHODS}}


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


def photographs_summary():
    """Two fabrics, of the second no fit succeeded."""
    seen = dict(node_count=7, drape_coefficient_percent=71.2, profile_mm=[120.0] * 360)
    fit = dict(outcome="succeeded", free=True, certified=True, outline_rms_mm=2.13, iou=0.9712,
               node_count=8, drape_coefficient_percent=72.5, seen=seen, parameters={},
               rigidity=[1e-5, 2e-5, 1.5e-5], profile_mm=[121.0] * 360)
    lost = fit | dict(outcome="branch_lost", free=False)
    unread = dict(outcome="failed", message="no picture")
    photographs = dict(drape_coefficients=[70.0, 73.0], node_counts=[7, 8])
    return dict(fabrics=[
        dict(fabric=1, photographs=photographs, fits=dict(printed=[fit, lost]),
             predictions=[fit | dict(change="face")],
             without_branch=dict(drape_coefficients=[65.0, 68.0], node_counts=[5, 6])),
        dict(fabric=2, photographs=photographs, fits=dict(printed=[unread, lost]))])


def identifiability_summary():
    """Four fabrics, one of which was not solved."""
    said = dict(log_sd=dict(k_h=0.4, k_bu=0.05), singular_values=[20.0, 2.5],
                directions=[[0.0, 1.0], [1.0, 0.0]])
    items = [dict(status="converged", drape_coefficient_percent=50.0 + i,
                  designs={"one picture": said, "two drapes": said}) for i in range(3)]
    return dict(parameters=["k_h", "k_bu"], items=items + [dict(status="stagnated")])


def tag_comparison_numbers():
    methods = ("tag", "picture", "both", "learned")
    return dict(held_out=40, compared=38, training=1000, learned=True, git_commit="0123456789ab",
                log_errors={name: {m: [0.1 * k, 0.2 * k, 0.4 * k]
                                   for k, m in enumerate(methods, start=1)}
                            for name in ("k_u", "k_v", "k_h", "k_bu", "k_bv", "k_bh")})


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
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

    def test_sheet_of_fifteen_is_readable(self):
        outcome = "start and target on different branches: the fit stopped at 1.2 mm after 60 steps"
        write(self.file, 15, outcomes=("succeeded", outcome, ""), status="no descent")
        page = drape_sheet.sheet(records.read(self.file))
        self.check_layout(page)
        words = self.words(page)
        for said in ("no drape: no descent", "no estimate", "different branches", "−75.0 %",
                     "estimates succeeded: 5 of 10"):
            self.assertIn(said, words)

    def test_sheets_of_other_sizes_are_readable(self):
        for count in (1, 2, 7):
            write(self.file, count)
            self.check_layout(drape_sheet.sheet(records.read(self.file)))

    def test_overlay_is_readable(self):
        for outcome in ("succeeded", "the guide could not be released at kappa = 0.01: snap"):
            write(self.file, 1, outcomes=(outcome,))
            results = records.read(self.file)
            page = estimate_overlay.overlay(results, results.records[:1])
            self.check_layout(page)
            self.assertEqual(outcome != "succeeded", "did not succeed" in self.words(page))

    def test_pages_of_studies_are_readable(self):
        summary = validation_summary()
        page = validation.page(summary)
        self.check_layout(page)
        words = self.words(page)
        for said in ("89 of 90", "cantilever 1.0", "soft anisotropic, 2000, ramp", "6 (6–10)"):
            self.assertIn(said, words)
        self.check_layout(validation.page(summary | {"mesh_bias": {}}))
        self.check_layout(accuracy.page(accuracy_summary()))
        page = photographs.page(photographs_summary())
        self.check_layout(page)
        words = self.words(page)
        for said in ("fabric 1   DC 71.2 → 72.5", "7 → 8 nodes, 2.13 mm, IoU 0.971",
                     "fabric 2: failed", "1, other face"):
            self.assertIn(said, words)
        page = identifiability.page(identifiability_summary())
        self.check_layout(page)
        self.assertIn("3 fabrics of the measured distribution", self.words(page))
        page = ablation.page(ablation_result())
        self.check_layout(page)
        self.assertIn("does not act where needed 1, acts needlessly 0", self.words(page))
        page = gradient_precision.page(gradients_result())
        self.check_layout(page)
        self.assertIn("Settings that failed: 1", self.words(page))
        page = snap_gradient.page(snap_result())
        self.check_layout(page)
        self.assertIn("1.2345 times", self.words(page))
        numbers = tag_comparison_numbers()
        page = tag_comparison.page(numbers)
        self.check_layout(page)
        self.assertIn("learned from 1000 fabrics", self.words(page))
        for of in numbers["log_errors"].values():
            del of["learned"]
        page = tag_comparison.page(numbers | {"learned": False})
        self.check_layout(page)
        self.assertIn("no scikit-learn", self.words(page))
        self.check_layout(stability.page(stability_atlas()))
        self.check_layout(estimation_precision.page(estimation_precision_chart()))
        chart = work_precision_chart()
        self.check_layout(work_precision.page(chart))
        self.check_layout(work_precision.page(chart | {"panels": chart["panels"][:1]}))

    def test_atlas_colours_every_cell_by_its_outcome(self):
        atlas = stability_atlas()
        page = stability.page(atlas)
        drawn = [patch.get_facecolor() for axes in page.figure.axes for patch in axes.patches]
        for outcome, (colour, _) in stability.OUTCOMES.items():
            cells = sum(cell["outcome"] == outcome for cell in atlas["cells"])
            self.assertEqual(drawn.count(stability.style.matplotlib.colors.to_rgba(colour)),
                             cells + 1, outcome)  # one in the legend

    def test_changes_are_without_the_jumps_of_snaps(self):
        cell = {"change": 2.5, "snap_change": 2.0, "snaps": 1, "outline_rms": 1.234e-3,
                "node_change": -1}
        self.assertEqual(ablation.change_words(cell), "+0.50'")
        self.assertEqual(ablation.rms_words(cell), "1.2\n(−1)")

    def test_ends_of_curves_say_what_became_of_the_runs(self):
        self.assertEqual(work_precision.end(["converged", "converged"]), ("o", None))
        self.assertEqual(work_precision.end(["stalled", "out_of_budget"]), ("o", "white"))
        self.assertEqual(work_precision.end(["converged", "stalled"]), ("x", None))

    def test_elastica_of_small_load_is_a_beam(self):
        # c/8 with corrections of order c^3 = 1e-6 and second-order differences
        self.assertAlmostEqual(validation.elastica_drop(0.1) / (0.001 / 8), 1, places=5)

    def test_scripts_of_studies_write_both_files(self):
        for script, summary in (("validation", validation_summary()),
                                ("accuracy", accuracy_summary()),
                                ("photographs", photographs_summary()),
                                ("identifiability", identifiability_summary()),
                                ("work_precision", work_precision_chart()),
                                ("stability", stability_atlas()),
                                ("estimation_precision", estimation_precision_chart()),
                                ("ablation", ablation_result()),
                                ("gradient_precision", gradients_result()),
                                ("snap_gradient", snap_result())):
            file = self.folder / "summary.json"
            file.write_text(json.dumps(summary))
            done = self.run_script(f"{script}.py", file, "--out", self.folder / script)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.folder / f"{script}.png").read_bytes().startswith(b"\x89PNG"))
            file.write_text("{}")
            done = self.run_script(f"{script}.py", file, "--out", self.folder / script)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_recovery_shows_every_outcome(self):
        write(self.file, 9, outcomes=("succeeded", "misfit", "the guide could not be released"))
        page = recovery.page_of(records.read(self.file))
        self.check_layout(page)
        words = self.words(page)
        for said in ("explains the outline: 3 of 9", "misfit remains: 3 of 9",
                     "branch lost or no start: 3 of 9"):
            self.assertIn(said, words)
        titles = " ".join(axes.get_title() for axes in page.figure.axes)
        self.assertIn("median |ln error| 1.39", titles)  # ln 4, of those found four times too small
        write(self.file, 2, outcomes=("",))
        self.check_layout(recovery.page_of(records.read(self.file)))

    def test_scene_of_a_render_has_the_drape(self):
        write(self.file, 8)
        results = records.read(self.file)
        chosen = render.chosen(results)
        self.assertEqual(len(chosen), 6)
        coefficients = [record.drape_coefficient for record in chosen]
        self.assertEqual(coefficients, sorted(coefficients))
        scene = render.scene(results, chosen[0].positions, (0.5, 0.6, 0.7))
        count = len(results.rest_uv)
        self.assertIn(f"vertex_vectors {{ {count}, ", scene)
        self.assertIn(f"face_indices {{ {len(results.triangles)}, ", scene)
        normals = render.vertex_normals(chosen[0].positions, results.triangles)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, rtol=1e-12)

    def test_paper_holds_figures_and_where_they_come_from(self):
        part = self.folder / "robustness"
        part.mkdir()
        page = style.Page(40, 30)
        page.text(2, 2, "x")
        page.save(part / "units")
        (part / "config.toml").write_text("[robustness]\nfabrics = 3  # <few>\n")
        (part / "summary.json").write_text(json.dumps(dict(
            kind="robustness", git_commit="abc123", cpu_seconds=12.4, certified_minima=3)))
        parts = [dict(name="robustness", config="/somewhere/experiments/configs/robustness.toml",
                      status="partial")]
        (self.folder / "parts.json").write_text(json.dumps(parts))
        done = self.run_script("paper.py", self.folder, "--out", self.folder / "figures")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "figures.html").read_text()
        for said in ("Figure 1. Cold drapes of random fabrics", "data:image/png;base64,", "abc123",
                     "./experiments/run experiments/configs/robustness.toml", "&lt;few&gt;",
                     "Status: partial", "<td>certified minima</td><td>3</td>"):
            self.assertIn(said, text)
        self.assertTrue((self.folder / "robustness_units.pdf").exists())
        (part / "summary.json").unlink()
        done = self.run_script("paper.py", self.folder, "--out", self.folder / "figures")
        self.assertEqual(done.returncode, 2)

    def test_ensemble_shows_every_minimum(self):
        write(self.file, 9)
        page = ensemble.picture(records.read(self.file))
        self.assertIn("9 starts end in 9 distinct minima", self.words(page))
        self.assertEqual(len(page.figure.axes[0].patches), 9)

    def test_branches_show_sweeps_and_snaps(self):
        write(self.file, 8)
        points = [dict(sweep="up" if i < 4 else "down", segment=int(2 <= i < 6), factor=0.5 + i % 4,
                       drape_coefficient_percent=50 + 5 * i, node_count=4 + i // 2, energy=-1e-3,
                       record=i) for i in range(8)]
        snap = dict(start="ramp", sweep="up", segment=0, factor=2.0, vertex_jump=0.01,
                    drape_coefficient_percent_before=56.0, drape_coefficient_percent_after=60.0,
                    drape_coefficient_percent_jump=4.0)
        small = dict(snap, segment=1, drape_coefficient_percent_jump=0.1,
                     drape_coefficient_percent_after=56.1)
        branch = dict(start="ramp", points=points, snaps=[snap, small])
        (self.folder / "branches.json").write_text(
            json.dumps(dict(branches=[branch], snaps=branch["snaps"])))
        page = branches.diagram(records.read(self.file), branches.read_branches(self.file))
        self.assertIn("2 snaps, 1 of them", self.words(page))
        ended = self.run_script("branches.py", self.file, "--out", self.folder / "picture")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        (self.folder / "branches.json").unlink()
        ended = self.run_script("branches.py", self.file, "--out", self.folder / "picture")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("branches.json: cannot be read", ended.stderr)

    def test_picture_of_a_dataset_is_readable(self):
        for count, status, said in ((15, "no descent", "14 drapes"), (1, "converged", "1 drapes"),
                                    (1, "no descent", "0 drapes")):
            write(self.file, count, status=status)
            page = dataset.picture(dataset.read(self.file))
            self.check_layout(page)
            self.assertIn(said, self.words(page))

    def test_scripts_write_both_files(self):
        write(self.file, 1)
        for script, stem in (("drape_sheet.py", "sheet"), ("estimate_overlay.py", "overlay"),
                             ("dataset.py", "dataset")):
            done = self.run_script(script, self.file, "--out", self.folder / "new" / stem)
            self.assertEqual(done.returncode, 0, done.stderr)
            files = [self.folder / "new" / f"{stem}.{suffix}" for suffix in ("png", "pdf")]
            self.assertEqual(done.stdout.split(), [str(file) for file in files])
            self.assertTrue(files[0].read_bytes().startswith(b"\x89PNG"))
            self.assertTrue(files[1].read_bytes().startswith(b"%PDF"))

    def test_chart_of_robustness_is_readable(self):
        head = "distribution,size,bending_length_m,cpu_seconds,unit_cpu_seconds,failure\n"
        rows = [f"{name},{size},{0.002 * 1.2**i},{0.1 + 0.02 * i},0.01,\n"
                for i in range(12) for name in ("measured", "wide") for size in (1000, 2000)]
        table = self.folder / "solves.csv"
        for failed, said in (("wide,2000,0.003,,,exception\n", "failed (wide box): 1"),
                             ("", "12 of 12, median 21.0")):
            table.write_text(head + "".join(rows) + failed)
            page = robustness.chart(robustness.read(table))
            self.check_layout(page)
            legends = [text.get_text() for axes in page.figure.axes
                       for text in axes.get_legend().get_texts()]
            self.assertIn(said, " ".join(legends))
        for content in ("", head, "a,b\n1,2\n", head + "wide,2000,x,1,1,\n"):
            table.write_text(content)
            done = self.run_script("robustness.py", table, "--out", self.folder / "units")
            self.assertEqual(done.returncode, 2, content)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_unreadable_input_is_one_line_and_exit_2(self):
        self.file.write_text("no HDF5")
        for script in ("drape_sheet.py", "estimate_overlay.py", "dataset.py"):
            for file in (self.file, self.folder / "missing.h5"):
                done = self.run_script(script, file, "--out", self.folder / "sheet")
                self.assertEqual(done.returncode, 2)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(str(file), done.stderr)
        write(self.file, 2)
        self.assertEqual(self.run_script("estimate_overlay.py", self.file, "--out",
                                         self.folder / "overlay").returncode, 2)


if __name__ == "__main__":
    unittest.main()
