#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the plots of docs/pictures.md and docs/benchmarks.md as SVG, from JSON that programs of msq write.

    python3 docs/images/plots.py statistics FOLDER    stats_*.json and calibrate_*.json of the command msq
    python3 docs/images/plots.py bench FOLDER         rays*.json of bench/rays: the least time of all files

scripts/make_pictures calls it.
"""
import json
import pathlib
import re
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
COLOURS = ["#c05a12", "#1f6f8b", "#5b8c3a", "#7a4f9a"]
matplotlib.rcParams.update({
    "svg.hashsalt": "msq", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#dddddd", "legend.frameon": False, "axes.axisbelow": True,
    "axes.prop_cycle": plt.cycler(color=COLOURS)})


def save(figure, name):
    path = HERE / f"{name}.svg"
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})  # the same bytes from the same numbers
    text = re.sub(r"[ \t]+$", "", path.read_text(encoding="utf-8"), flags=re.M)
    path.write_text(text, encoding="utf-8")
    print(f"{path}: {path.stat().st_size} bytes")


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def plot_statistics(folder):
    figure, (correlation, path, curve) = plt.subplots(1, 3, figsize=(12, 3.8))
    for jitter in ("0.2", "1"):
        found = read(folder / f"stats_{jitter}.json")
        for axes, key in ((correlation, "two_point"), (path, "lineal_path")):
            rows = found[key]
            lengths, values = [r["length"] for r in rows], [r["value"] for r in rows]
            errors = [2 * r["standard_error"] for r in rows]
            line, = axes.plot(lengths, values, label=f"foam, jitter {jitter}")
            axes.fill_between(lengths, [v - e for v, e in zip(values, errors)],
                              [v + e for v, e in zip(values, errors)], color=line.get_color(), alpha=0.25)
        phi = found["volume_fraction"]["value"]
        correlation.axhline(phi ** 2, color="#999999", linewidth=0.8, linestyle=":")
    correlation.set(xlabel="length / cell size", ylabel="both ends in a pore",
                    title="Two-point correlation S₂ (dotted: φ²)")
    path.set(xlabel="length / cell size", ylabel="the whole segment in a pore", title="Lineal path L",
             yscale="log", ylim=(0.03, 1))
    path.yaxis.set_major_locator(matplotlib.ticker.FixedLocator([0.05, 0.1, 0.2, 0.5, 1]))
    path.yaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    path.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    for name, label in (("foam", "Voronoi foam"), ("bcc", "BCC"), ("octet", "octet"), ("kelvin", "Kelvin")):
        found = read(folder / f"calibrate_{name}.json")
        pairs = [(p["radius"], p["volume_fraction"]) for p in found["curve"]]
        curve.plot([p[0] for p in pairs], [p[1] for p in pairs], label=label)
    curve.set(xlabel="radius / cell size", ylabel="solid fraction", title="Calibration", xlim=(0, 0.3), ylim=(0, 1))
    for axes in (correlation, path, curve):
        axes.legend()
    save(figure, "statistics")


def bars(axes, rows, title, unit):
    rows = list(reversed(rows))
    colours = [COLOURS[0] if name.startswith("msq") else "#8fa3ad" for name, _ in rows]
    axes.barh([name for name, _ in rows], [value for _, value in rows], color=colours)
    for i, (_, value) in enumerate(rows):
        axes.text(value, i, f" {value:.3g}", va="center")
    axes.set(title=title, xlabel=unit, xlim=(0, 1.18 * max(value for _, value in rows)))
    axes.grid(axis="y", visible=False)


def least_processor_time(folder):
    """Least processor time of each work in all files; bench/rays notes the half of it, for two threads."""
    least = {}
    for path in sorted(folder.glob("rays*.json")):
        found = read(path)
        halves = [n["value"] for n in found["notes"] if n["what"].strip() == "half the processor time"]
        for row, half in zip(found["rows"], halves):
            least[row["work"]] = min(half, least.get(row["work"], float("inf")))
    return least


def plot_bench(folder):
    rays = least_processor_time(folder)
    figure, (peers, paper) = plt.subplots(1, 2, figsize=(11, 2.6))
    name = next(work for work in rays if work.startswith("Embree: ") and "packets" in work)[len("Embree: "):]
    name = name[:name.index("packets")]
    unit = "seconds: half the processor time of two threads"
    bars(peers, [("msq", rays[f"msq: {name}next frame"]),
                 ("Embree, packets of 16", rays[f"Embree: {name}packets of 16"]),
                 ("Embree, single rays", rays[f"Embree: {name}single rays"])],
         "1024² rays to a foam of 32³ cells", unit)
    rows = [("msq_render", rays["msq_render, 128^2, 32^3 cells, front, next frame"])]
    for method in ("DIRECT", "METHOD_1", "METHOD_2"):
        work = next(w for w in rays if "march" in w and method in w and w.endswith("next frame"))
        rows.append((f"msq {method}, march" if method == "DIRECT" else f"{method}, march", rays[work]))
    bars(paper, rows, "128² rays: the paper's march in steps", unit)
    save(figure, "benchmarks")


def plot_paper_tables(found, resolutions):
    """Seconds by (fine scale, cells, query) and samples along a side; bench/tables calls it."""
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.8), sharey=True)
    lines = (("point of the paper", "the paper's point query"), ("METHOD_1", "method 1"), ("METHOD_2", "method 2"),
             ("set", "msq"))
    for axes, cells in zip(panels, (32, 128, 256)):
        for query, label in lines:
            seconds = found.get(("Voronoi foam", cells, query), {})
            wanted = [r for r in resolutions if r in seconds]
            axes.plot(wanted, [seconds[r] for r in wanted], marker="o", label=label)
        axes.set(title=f"Voronoi foam, {cells}³ cells", xlabel="samples along a side", xscale="log", yscale="log")
        axes.xaxis.set_major_locator(matplotlib.ticker.FixedLocator(list(resolutions)))
        axes.xaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%d"))
        axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    panels[0].set(ylabel="seconds, one thread")
    panels[0].legend()
    save(figure, "paper_tables")


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("statistics", "bench"):
        print(__doc__, file=sys.stderr)
        return 2
    (plot_statistics if sys.argv[1] == "statistics" else plot_bench)(pathlib.Path(sys.argv[2]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
