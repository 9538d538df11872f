#!/usr/bin/python3
"""The figures of studies on made-up results: they write what they promise and no two texts of a page
overlap."""

import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from figures import FigureTest  # noqa: E402  (finds the scripts as well)

import ablation  # noqa: E402
import ablation_photographs  # noqa: E402
import accuracy  # noqa: E402
import estimation_precision  # noqa: E402
import gradient_precision  # noqa: E402
import identifiability  # noqa: E402
import photographs  # noqa: E402
import snap_gradient  # noqa: E402
import stability  # noqa: E402
import stability_methods  # noqa: E402
import style  # noqa: E402
import tag_comparison  # noqa: E402
import validation  # noqa: E402
import work_precision  # noqa: E402


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
        for start in ("lobes", "coarse_ramp")}
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
            cell = {"ingredient": name, "fabric": str(fabric), "status": "converged", "followed": i != 2,
                    "snaps": int(i == 3), "snap_change": 2.0 * (i == 3), "cpu_ratio": 0.5 + 0.1 * i,
                    "change": -0.004 * 3.0 ** (i % 8), "outline_rms": 1e-5 * 2.2 ** (i % 9),
                    "node_change": -1 if i == 4 else 0}
            cells.append({k: v for k, v in cell.items() if i != 5 or k not in
                          ("change", "outline_rms", "node_change")})
    rule = {"checked": 6, "acts_where_needed": 2, "idle_where_not_needed": 3, "acts_needlessly": 0,
            "idle_where_needed": 1}
    fabrics = [{"name": str(i), "status": "converged", "drape_coefficient_percent": 15 * i + 10.0,
                "miss_mm": 2.5} for i in range(6)] + [{"name": "6", "status": "no drape"}]
    rows = [{"name": name, "label": "threshold read otherwise", "followed": 6} for name in names]
    return {"vertices": 1000, "tolerance_points": 0.5, "outline_tolerance_mm": 1.0,
            "fabrics": fabrics, "ingredients": rows,
            "contact_rule": rule | {"cells": [{"penetration": 1e-4 * 4.0**i, "change": 0.01 * 3.0**i}
                                              for i in range(6)]},
            "resolution_rule": rule | {"cells": [
                {"status": "within_tolerance", "estimate": 0.1 * 2.0**i, "error": 0.03 * 2.0**i,
                 "same_branch": i > 0} for i in range(6)] + [{"status": "limited_by_solver"}]},
            "cells": cells,
            "photographs": {"fabrics": fabrics, "ingredients": rows, "cells": [
                cell | {"miss_change": 1e-4 * i} for i, cell in enumerate(cells)]}}


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
            "methods": {method: {
                "label": "implicit Euler, one solve", "limits": "" if i == 0 else "It is slow. " * 30,
                "outcomes": {"converged": 20, "stalled": i, "diverged": 2 * i},
                "measured": f"Converged in 20 of {20 + 3 * i} runs. " + "By vertices 1/2 at 250. " * 12}
                        for i, method in enumerate(METHODS)}}


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
             without_branch=dict(drape_coefficients=[65.0, 68.0], node_counts=[5, 6],
                                 drape_coefficient_percent=68.0, node_count=6)),
        dict(fabric=2, photographs=photographs, fits=dict(printed=[unread, lost]))])


def identifiability_summary():
    """Four fabrics, one of which was not solved."""
    said = dict(log_sd=dict(k_h=0.4, k_bu=0.05), singular_values=[20.0, 2.5],
                directions=[[0.0, 1.0], [1.0, 0.0]])
    items = [dict(status="converged", drape_coefficient_percent=50.0 + i,
                  designs={"one picture": said, "two drapes": said}) for i in range(3)]
    return dict(parameters=["k_h", "k_bu"], items=items + [dict(status="stagnated")])


def tag_comparison_numbers():
    methods = ("tag", "regression", "picture", "both", "learned")
    return dict(held_out=40, compared=38, training=1000, learned=True, git_commit="0123456789ab",
                log_errors={name: {m: [0.1 * k, 0.2 * k, 0.4 * k]
                                   for k, m in enumerate(methods, start=1)}
                            for name in ("k_u", "k_v", "k_h", "k_bu", "k_bv", "k_bh")})


class Studies(FigureTest):
    def test_pages_of_studies_are_readable(self):
        summary = validation_summary()
        page = validation.page(summary)
        self.check_layout(page)
        words = self.words(page)
        for said in ("89 of 90", "cantilever 1.0", "soft aniso., 2000, coarse ramp", "6 (6–10)"):
            self.assertIn(said, words)
        self.check_layout(validation.page(summary | {"mesh_bias": {}, "cantilever_order": None}))
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
        page = ablation_photographs.page(ablation_result())
        self.check_layout(page)
        self.assertIn("Pictures: 7, draped: 6, with drape coefficients from 10 to 85",
                      self.words(page))
        page = gradient_precision.page(gradients_result())
        self.check_layout(page)
        self.assertIn("Settings that failed: 1", self.words(page))
        page = snap_gradient.page(snap_result())
        self.check_layout(page)
        self.assertIn("1.2345 times", self.words(page))
        numbers = tag_comparison_numbers()
        page = tag_comparison.page(numbers)
        self.check_layout(page)
        for said in ("tag (model)", "tag (regression)", "learned from 1000 fabrics"):
            self.assertIn(said, self.words(page))
        for of in numbers["log_errors"].values():
            del of["learned"]
        page = tag_comparison.page(numbers | {"learned": False})
        self.check_layout(page)
        self.assertIn("no scikit-learn", self.words(page))
        self.check_layout(stability.page(stability_atlas()))
        page = stability_methods.page(stability_atlas())
        self.check_layout(page)
        for said in ("Converged in 20 of 20 runs", "Converged in 20 of 23 runs", "It is slow."):
            self.assertIn(said, self.words(page))
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

    def test_few_fabrics_leave_no_gap_on_the_page_of_an_ablation(self):
        for count in (0, 1, 2, 6):
            result = ablation_result()
            drape = {"status": "converged", "drape_coefficient_percent": 50}
            result |= {"fabrics": [drape | {"name": str(i)} for i in range(count)],
                       "cells": [c for c in result["cells"] if int(c["fabric"]) < count]}
            page = ablation.page(result)
            self.check_layout(page)
            panels = [axes.get_position() for axes in page.figure.axes[:3]]
            for left, right in zip(panels, panels[1:]):
                self.assertAlmostEqual((right.x0 - left.x1) * page.width, ablation.GAP)
            self.assertAlmostEqual((1 - panels[-1].x1) * page.width, 6)

    def test_bars_of_methods_are_shares_of_outcomes(self):
        atlas = stability_atlas()
        page = stability_methods.page(atlas)
        accounts = list(atlas["methods"].values())
        for axes, account in zip(page.figure.axes, accounts):
            widths = [patch.get_width() for patch in axes.patches]
            self.assertEqual(dict(zip(stability.OUTCOMES, widths)),
                             dict.fromkeys(stability.OUTCOMES, 0) | account["outcomes"])
            self.assertEqual(axes.get_xlim()[1], sum(account["outcomes"].values()))

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
                                ("stability_methods", stability_atlas()),
                                ("ablation_photographs", ablation_result()),
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


if __name__ == "__main__":
    unittest.main()
