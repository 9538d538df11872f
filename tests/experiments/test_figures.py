#!/usr/bin/python3
"""The figure scripts on made-up results: they write what they promise, say failures in words, and no
two texts of a page overlap."""

import json
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from figures import FigureTest, drape, write  # noqa: E402  (finds the scripts as well)

import branches  # noqa: E402
import dataset  # noqa: E402
import drape_sheet  # noqa: E402
import ensemble  # noqa: E402
import estimate_overlay  # noqa: E402
import paper  # noqa: E402
import recovery  # noqa: E402
import render  # noqa: E402
import results as records  # noqa: E402
import robustness  # noqa: E402
import style  # noqa: E402


class Figures(FigureTest):
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
            page = estimate_overlay.page_of(records.read(self.file))
            self.check_layout(page)
            self.assertEqual(outcome != "succeeded", "did not succeed" in self.words(page))

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

    def test_normals_of_vertices_weigh_triangles_by_area(self):
        # a horizontal triangle of area 3/2 and an upright one of area 1/2 share the vertices 0, 1
        points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 3, 0], [0, 0, 1]])
        normals = style.vertex_normals(points, np.array([[0, 1, 2], [0, 1, 3]]))
        np.testing.assert_allclose(normals[0], np.array([0, -1, 3]) / np.sqrt(10), atol=1e-15)
        np.testing.assert_allclose(normals[2], [0, 0, 1], atol=1e-15)
        np.testing.assert_allclose(normals[3], [0, -1, 0], atol=1e-15)

    def test_paper_holds_figures_and_where_they_come_from(self):
        part = self.folder / "robustness"
        part.mkdir()
        page = style.Page(40, 30)
        page.text(2, 2, "x")
        page.save(part / "units")
        (part / "config.toml").write_text("[robustness]\nfabrics = 3  # <few>\n")
        (part / "summary.json").write_text(json.dumps(dict(
            kind="robustness", git_commit="abc123", cpu_seconds=12.4, certified_minima=3,
            fabrics=["a list is no number to read"])))
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
        self.assertNotIn("a list is no number", text)
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
                             ("dataset.py", "dataset"), ("ensemble.py", "ensemble"),
                             ("recovery.py", "recovery")):
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
        done = self.run_script("estimate_overlay.py", self.file, "--out", self.folder / "overlay")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{self.file}: holds estimates of 2 fabrics", done.stderr)


if __name__ == "__main__":
    unittest.main()
