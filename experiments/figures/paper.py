#!/usr/bin/python3
"""All figures of a set of experiments on one page that opens offline.

    /usr/bin/python3 paper.py FOLDER --out FOLDER/figures

Reads FOLDER/parts.json and the part folders beside it (runs of kind "paper"). Copies every figure
as NAME.pdf and NAME.png next to the page and writes FOLDER/figures.html: the figures with captions,
the command and the settings of each, the commit and the machine.
"""

import argparse
import base64
import html
import json
import os
import platform
import shutil
import sys
from pathlib import Path

# What a figure shows, by its kind and the name of its file. Figures without an entry are called by
# their names.
CAPTIONS = {
    ("quickstart", "sheet"):
        "The fabrics of Fig. 2 of Ju et al. 2024: drapes from above, outlines of target, start and "
        "estimate, and the parameters found back from the outline of the shadow.",
    ("quickstart", "overlay"): "A photographed drape and the drape of the parameters found from it.",
    ("quickstart", "recovery"): "The same parameters against the true ones.",
    ("estimate", "recovery"):
        "Recovery of random fabrics from the outline alone: estimated against true parameters.",
    ("dataset", "dataset"):
        "A generated dataset: types as in Table 1 and fibres as in Table 2 of the source, weight "
        "against bending, drape coefficients and nodes, one drape of each type.",
    ("dataset", "renders"): "Equilibria of the dataset in light and shadow, from limp to stiff.",
    ("robustness", "units"):
        "Cold drapes of random fabrics: work in factorisation-equivalents against the bending "
        "length.",
    ("accuracy", "accuracy"):
        "Error of the drape coefficient against mesh size and CPU time, on the branch of the finest "
        "mesh.",
    ("validation", "validation"):
        "Strips and plates against solutions that are not this code: the heavy elastica, the "
        "hanging strip, the clamped annulus, and meshes turned under the fabric.",
    ("branches", "branches"):
        "Drapes followed in bending stiffness, up and down: branches, limit points and snaps.",
    ("identifiability", "identifiability"):
        "What outlines say of each parameter: one picture, two drapes, three specimen sizes.",
    ("photographs", "photographs"):
        "Photographed drapes, fits, and predictions for pictures that were left out.",
    ("work_precision", "rms_mm"):
        "Distance to the minimum of a method's own basin against CPU time, for every method.",
    ("work_precision", "drape_coefficient_error"):
        "Error of the drape coefficient against CPU time, for every method.",
    ("work_precision", "residual"): "Residual against CPU time, for every method.",
    ("gradient_precision", "gradients"):
        "Error of the outline's gradient against CPU time and memory, by four ways to differentiate.",
    ("gradient_precision", "snap"):
        "The gradient on both sides of a limit point, where a branch ends in a snap.",
    ("estimation_precision", "estimation_precision"):
        "What exact derivatives buy in a fit: outline and parameter error against CPU time.",
    ("tag_comparison", "tag_comparison"):
        "What a tag, the picture of one drape, both and a learned regressor tell of a fabric.",
    ("ablation", "ablation"):
        "What each ingredient of the model changes of a drape, and what it costs.",
    ("stability", "atlas"): "Where every method converges, stalls, diverges or runs out of time.",
    ("stability", "methods"): "The same in words, and why methods of each kind fail there.",
}

# Numbers worth reading beside a figure, where a summary has them.
FACTS = {
    "fabrics": "fabrics",
    "certified_minima": "certified minima",
    "worst_residual_over_target": "largest residual over its target",
    "max_relative_error": "largest relative error",
    "adjoint_versus_tangent_max": "adjoint against tangent",
    "adjoint_factorization_equivalents": "adjoint, factorisation-equivalents",
    "recovered": "recovered",
    "median_outline_rms_mm": "median outline rms, mm",
    "drapes_per_cpu_second": "drapes per CPU second",
    "drape_coefficient_percent": "drape coefficient, per cent",
    "node_count": "nodes",
    "skipped": "skipped",
}

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em;
       color: #222; }
figure { margin: 0 0 4em; border-top: 1px solid #ccc; padding-top: 1em; }
img { max-width: 100%; }
figcaption b { display: block; margin: .5em 0 .2em; }
code, pre { font: 12px/1.45 ui-monospace, monospace; background: #f5f5f5; }
pre { padding: .8em; overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; }
td, th { padding: .15em .9em .15em 0; text-align: left; vertical-align: top; }
.status { color: #C23B00; }
"""


def figures_of(folder):
    """The PNG files of a part and of its subfolders, those above first."""
    return sorted(folder.rglob("*.png"), key=lambda path: (len(path.parts), path.name))


def caption(kind, path):
    words = f"{path.stem} of {path.parent.name}".replace("_", " ").capitalize() + "."
    return CAPTIONS.get((kind, path.stem), words)


def collected(folder, name, pictures):
    """Copies the pictures of a part, with their PDF, to the folder; returns (picture, stem)."""
    copies = []
    for picture in pictures:
        words = [name, picture.parent.name, picture.stem]  # part, its subfolder, figure
        stem = "_".join(dict.fromkeys(words))  # without what is said twice
        for suffix in (".png", ".pdf"):
            source = picture.with_suffix(suffix)
            if source.exists():
                shutil.copyfile(source, folder / (stem + suffix))
        copies.append((picture, stem))
    return copies


def figure_html(number, kind, picture, stem):
    image = base64.b64encode(picture.read_bytes()).decode("ascii")
    text = html.escape(caption(kind, picture))
    return (f'<figure id="{stem}"><img alt="{text}" src="data:image/png;base64,{image}">'
            f"<figcaption><b>Figure {number}. {text}</b>Files: <code>{stem}.pdf</code>, "
            f"<code>{stem}.png</code></figcaption>")


def provenance_html(part, summary, config):
    facts = "".join(f"<tr><td>{label}</td><td>{html.escape(fact(summary[key]))}</td></tr>"
                    for key, label in FACTS.items()
                    if isinstance(summary.get(key), (int, float, str)))
    shown = config_name(part["config"])
    command = f"./experiments/run {shown} --out DIR"
    status = "" if part["status"] == "ok" else (
        f'<p class="status">Status: {html.escape(part["status"])}; some solve failed, and the '
        "figure says which.</p>")
    return (f"{status}<p>Command: <code>{html.escape(command)}</code></p><table>"
            f"<tr><td>commit</td><td><code>{html.escape(summary['git_commit'])}</code></td></tr>"
            f"<tr><td>CPU time of the run</td><td>{summary['cpu_seconds']:.0f} s</td></tr>{facts}"
            f"</table><details><summary>All settings</summary><pre>{html.escape(config)}</pre>"
            "</details>")


def fact(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def config_name(path):
    """A config of the project by its path in the repository, another as it is."""
    parts = Path(path).parts
    return "/".join(parts[parts.index("experiments"):]) if "experiments" in parts else path


def machine():
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next(line.split(":", 1)[1].strip() for line in file
                         if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{model}, {os.cpu_count()} processors, {platform.system()} {platform.release()}"


def page(folder, parts):
    """The whole page; copies the figures on the way."""
    body, contents, number = [], [], 0
    for part in parts:
        part_folder = folder / part["name"]
        summary = json.loads((part_folder / "summary.json").read_text(encoding="utf-8"))
        config = (part_folder / "config.toml").read_text(encoding="utf-8")
        copies = collected(folder, part["name"], figures_of(part_folder))
        provenance = provenance_html(part, summary, config)
        if not copies:
            title = html.escape(part["name"].replace("_", " ").capitalize())
            body.append(f'<figure id="{part["name"]}"><figcaption><b>{title}: no figure, its '
                        f"numbers.</b></figcaption>{provenance}</figure>")
        for picture, stem in copies:
            number += 1
            body.append(figure_html(number, summary["kind"], picture, stem) + provenance +
                        "</figure>")
            contents.append(f'<li><a href="#{stem}">'
                            f"{html.escape(caption(summary['kind'], picture))}</a></li>")
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Drape: figures'
            f"</title><style>{STYLE}</style></head><body><h1>Figures</h1><p>Made on "
            f"{html.escape(machine())}. CPU times are those of this machine.</p><ol>"
            f"{''.join(contents)}</ol>{''.join(body)}</body></html>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of a run of kind paper")
    parser.add_argument("--out", required=True, type=Path, help="path and stem of the page")
    arguments = parser.parse_args()
    try:
        parts = json.loads((arguments.folder / "parts.json").read_text(encoding="utf-8"))
        text = page(arguments.folder, parts)
    except (OSError, ValueError, KeyError) as error:
        print(f"{arguments.folder}: cannot be read as a run of kind paper: {error!r}",
              file=sys.stderr)
        sys.exit(2)
    target = arguments.out.with_suffix(".html")
    target.write_text(text, encoding="utf-8")
    print(target)


if __name__ == "__main__":
    main()
