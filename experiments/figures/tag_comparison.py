#!/usr/bin/python3
"""What the tag, the picture of one drape and both tell of each parameter, beside regressions on
other fabrics, over fabrics that none of them has seen.

    /usr/bin/python3 tag_comparison.py DIR/results.h5 --out DIR/tag_comparison

DIR is the folder of a run of kind tag_comparison. Writes .png, .pdf and the numbers as .json. The
regression on tag and picture is scikit-learn's (package python3-sklearn); without it the others are
compared.
"""

import argparse
import json
import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np

import style

try:
    from sklearn.ensemble import ExtraTreesRegressor
except ImportError:
    ExtraTreesRegressor = None

METHODS = {  # label -> colour
    "tag": style.START,
    "regression": "#CC79A7",
    "picture": "#7A7A7A",
    "both": style.ESTIMATE,
    "learned": "#009E73",
}
HARMONICS = 15  # of the profile that the regressor sees
INSIDE_90 = 1.645  # standard deviations


def symbol(parameter):
    letter, _, index = parameter.partition("_")
    return f"${letter}_{{{index}}}$"


class Table:
    """The columns of a table of records that are compared."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.config = tomllib.loads(file.attrs["config"])
            self.converged = file["stats/status"].asstr()[...] == "converged"
            self.truth = {name: file[f"params/{name}"][...] for name in file["params"]}
            self.tag = {name: file[f"fabric/{name}"].asstr()[...]
                        for name in ("category", "type", "composition")}
            self.profile = file["observation/profile"][...]
            self.git_commit = str(file.attrs["git_commit"])
            groups = ("params_estimated", "params_estimated_log_sd", "params_start")
            self.estimates = {group: {name: file[f"{group}/{name}"][...] for name in file[group]}
                              for group in groups if group in file}

    def estimated(self):
        """The parameters that were estimated, and where there is an estimate."""
        log_sd = self.estimates["params_estimated_log_sd"]
        names = [name for name in self.config["estimate"]["parameters"]
                 if np.isfinite(log_sd[name]).any()]
        return names, np.all([np.isfinite(log_sd[name]) for name in names], axis=0)


def noise(profiles, settings, chance):
    """Smooth noise as the fits see it: harmonics of equal variance and random phases."""
    if not settings["add_noise"]:
        return 0
    angle = np.linspace(0, 2 * np.pi, profiles.shape[1], endpoint=False)
    total = np.zeros_like(profiles)
    for k in range(settings["noise_harmonics"] + 1):
        phase = chance.uniform(0, 2 * np.pi, (len(profiles), 1))
        total += (np.sqrt(0.5) if k == 0 else 1) * np.cos(k * angle + phase)
    return settings["outline_noise"] * total / np.sqrt(np.mean(total**2, axis=1, keepdims=True))


def outline_features(profile):
    """Of each profile: what its harmonics are, and towards the weft those that anisotropy feeds."""
    harmonics = np.fft.rfft(profile, axis=1)[:, :HARMONICS + 1] / profile.shape[1]
    area = 0.5 * np.mean(profile**2, axis=1, keepdims=True)
    even = harmonics[:, 2:9:2]
    return np.hstack([area, np.abs(harmonics), even.real, even.imag])


def tag_features(table, words):
    """Logarithm of the weight, and the share of each category, type and fibre."""
    rows = []
    for i, density in enumerate(table.truth["areal_density"]):
        share = {table.tag["category"][i]: 100.0, table.tag["type"][i]: 100.0}
        for part in filter(None, map(str.strip, table.tag["composition"][i].split(";"))):
            fibre, _, percent = part.rpartition(" ")
            share[fibre] = float(percent)
        rows.append([np.log(density)] + [share.get(word, 0.0) for word in words])
    return np.array(rows)


def vocabulary(table):
    fibres = {part.strip().rpartition(" ")[0] for text in table.tag["composition"]
              for part in text.split(";")}
    return sorted(set(table.tag["category"]) | set(table.tag["type"]) | fibres)


def learned(training, held_out, names):
    """What the regressor says of the held-out fabrics: name -> logarithms; none without it."""
    if ExtraTreesRegressor is None:
        return {}
    settings = held_out.config["estimate"]
    chance = np.random.default_rng(held_out.config["experiment"]["seed"])
    words = vocabulary(training)

    def features(table):
        seen = table.profile + noise(table.profile, settings, chance)
        return np.hstack([tag_features(table, words), outline_features(seen)])

    targets = np.log([training.truth[name] for name in names]).T
    kept = training.converged
    regressor = ExtraTreesRegressor(500, min_samples_leaf=2, max_features=0.5, random_state=1)
    regressor.fit(features(training)[kept], targets[kept])
    usable = np.isfinite(held_out.profile).all(axis=1)
    said = np.full((len(usable), len(names)), np.nan)
    said[usable] = regressor.predict(features(held_out)[usable])
    return dict(zip(names, said.T))


def compare(folder):
    """The numbers: over the fabrics that every method has an estimate of."""
    both, picture = Table(folder / "both/results.h5"), Table(folder / "picture/results.h5")
    training = Table(folder / "training/results.h5")
    names, with_both = both.estimated()
    names = [name for name in names if not name.startswith("t_")]
    with_picture = picture.estimated()[1]
    common = with_both & with_picture
    if not common.any():
        raise ValueError("no fabric has an estimate from its picture")
    regression = json.loads((folder / "tag_regression.json").read_text(encoding="utf-8"))
    said = {"tag": {name: np.log(both.estimates["params_start"][name]) for name in names},
            "regression": {name: np.array(regression["mean"][name]) for name in names},
            "picture": {name: np.log(picture.estimates["params_estimated"][name])
                        for name in names},
            "both": {name: np.log(both.estimates["params_estimated"][name]) for name in names},
            "learned": learned(training, both, names)}
    errors = {name: {method: np.abs(values[name] - np.log(both.truth[name]))[common]
                     for method, values in said.items() if values} for name in names}
    log_sd = {"regression": {name: np.array(regression["sd"][name]) for name in names},
              "picture": picture.estimates["params_estimated_log_sd"],
              "both": both.estimates["params_estimated_log_sd"]}
    inside = {name: {method: float(np.mean(
        errors[name][method] <= INSIDE_90 * sd[name][common])) for method, sd in log_sd.items()}
        for name in names}
    return {"held_out": len(common), "compared": int(common.sum()),
            "without_estimate": {"picture": int((~with_picture).sum()),
                                 "both": int((~with_both).sum())},
            "training": int(training.converged.sum()), "learned": bool(said["learned"]),
            "regression": {"fabrics": regression["fabrics"],
                           "r_squared": {name: regression["r_squared"][name] for name in names}},
            "git_commit": both.git_commit,
            "log_errors": {name: {method: np.quantile(values, (0.25, 0.5, 0.75)).tolist()
                                  for method, values in of.items()}
                           for name, of in errors.items()},
            "truth_inside_90_percent_interval": inside}


def page(numbers):
    names = list(numbers["log_errors"])
    methods = [method for method in METHODS if method in numbers["log_errors"][names[0]]]
    row = 15
    sheet = style.Page(150, 36 + row * len(names))
    sheet.text(6, 4, "What a tag and a picture tell", fontsize=11, weight="bold")
    sheet.text(6, 10.5, f"{numbers['compared']} fabrics that no method has seen; |ln(estimate / "
               "truth)|: median and quartiles; all are told the weight", fontsize=6.5)
    axes = sheet.axes(20, 22, 122, row * len(names))
    for place, name in enumerate(names):
        for k, method in enumerate(methods):
            low, middle, high = numbers["log_errors"][name][method]
            y = place + (k - (len(methods) - 1) / 2) * 0.17
            axes.plot([low, high], [y, y], color=METHODS[method], linewidth=1.6)
            axes.plot(middle, y, "o", color=METHODS[method], markersize=4)
            axes.annotate(style.number(middle), (high, y), xytext=(3, 0),
                          textcoords="offset points", fontsize=6, va="center", color="#555555")
        if place:
            axes.axhline(place - 0.5, color=style.FAINT, linewidth=0.3)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xlim(0, 1.12 * max(q[2] for of in numbers["log_errors"].values()
                                for q in of.values()))
    axes.set_yticks(range(len(names)), [symbol(name) for name in names], fontsize=8)
    axes.set_xlabel("|ln error|  (0.1: 10 %, 0.7: a factor of 2)", fontsize=6.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    words = {"tag": "tag (model)", "regression": "tag (regression)", "picture": "picture",
             "both": "tag and picture", "learned": f"learned from {numbers['training']} fabrics"}
    places = dict(zip(METHODS, (20, 41, 67, 83, 108)))
    for method in methods:
        sheet.text(places[method], 16, words[method], color=METHODS[method], weight="bold",
                   fontsize=7)
    if not numbers["learned"]:
        sheet.text(places["learned"], 16, "learned: no scikit-learn", fontsize=6)
    sheet.text(6, sheet.height - 5, f"Drape, commit {numbers['git_commit'][:12]}", fontsize=6,
               color="#666666")
    return sheet


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", help="the results.h5 of a run of kind tag_comparison")
    parser.add_argument("--out", required=True, help="path of the picture without its suffix")
    arguments = parser.parse_args()
    try:
        numbers = compare(Path(arguments.results).parent)
    except (OSError, KeyError, ValueError) as error:
        print(f"{arguments.results}: cannot be compared: {error}", file=sys.stderr)
        sys.exit(2)
    file = Path(arguments.out).with_suffix(".json")
    file.write_text(json.dumps(numbers, indent=2) + "\n", encoding="utf-8")
    for file in [file, *page(numbers).save(arguments.out)]:
        print(file)


if __name__ == "__main__":
    main()
