#!/usr/bin/env python3
"""Draws docs/excluded_volume/aspect_ratio.svg: <V_ex>/V of two equal bodies against their aspect ratio.

    python3 docs/excluded_volume/draw.py build/release/bin/vex_mesh docs/excluded_volume

Runs vex_mesh some 230 times, which takes a minute, and needs matplotlib (Debian: python3-matplotlib). The curves are the
formula, the points are Monte Carlo runs of seed 1 to a relative standard error of 1e-4. The picture is the same bytes for
the same numbers and version of matplotlib.
"""
import json
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

matplotlib.rcParams.update({
    "svg.hashsalt": "vex", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11,
    "axes.spines.top": False, "axes.spines.right": False,
})
BLUE, ORANGE, GREEN, PURPLE, GREY = "#1f5fa8", "#c8500a", "#2f7d4f", "#7a4a9e", "#888888"

# A ratio is the length along the axis of symmetry over the width across it.
BODIES = [
    ("box, two sides equal", BLUE, lambda k: f"box:1,1,{k!r}", lambda k: True),
    ("cylinder", GREEN, lambda k: f"cylinder:{k!r},0.5", lambda k: True),
    ("spheroid", GREY, lambda k: f"ellipsoid:1,1,{k!r}", lambda k: True),
    ("spherocylinder", PURPLE, lambda k: f"capsule:{k - 1!r},0.5", lambda k: k > 1.01),
]
RATIOS = [10.0 ** (n / 10.0) for n in range(-30, 31)]

# cond-mat/0207739, Table I: aspect ratio, Monte Carlo, uncertainty, exact (docs/erratum.md).
PAPER = [
    (0.01, 182.760, 0.048, 207.02), (0.5, 11.488, 0.002, 12.0), (0.6, 11.058, 0.002, 11 + 8 / 15),
    (0.7, 10.804, 0.001, 11.25714286), (0.8, 10.659, 0.001, 11.1), (0.9, 10.591, 0.001, 11.02222222),
    (1.0, 10.569, 0.001, 11.0), (2.0, 11.543, 0.003, 12.0), (4.0, 15.023, 0.003, 15.5), (8.0, 22.774, 0.007, 23.25),
    (16.0, 38.654, 0.016, 39.125), (32.0, 70.624, 0.046, 71.0625), (64.0, 134.599, 0.175, 135.03125),
]


def run(program, body):
    out = subprocess.run([program, body, "--unit-volume", "--rel-error", "1e-4", "--quiet", "--json", "-"], check=True,
                         capture_output=True)
    result = json.loads(out.stdout)
    estimate = result["estimate"]
    return result["formula"]["excluded_volume"], estimate["excluded_volume"], estimate["std_error"]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1:]
    figure, (axes, deviation) = plt.subplots(2, 1, figsize=(7.2, 6.4), sharex=True, height_ratios=[5, 3],
                                             constrained_layout=True)
    farthest = 0.0  # from the formula, in percent, of all runs
    for name, colour, text, exists in BODIES:
        ratios = [k for k in RATIOS if exists(k)]
        rows = [run(program, text(k)) for k in ratios]
        farthest = max([farthest] + [abs(100.0 * (row[1] - row[0]) / row[0]) for row in rows])
        axes.plot(ratios, [formula for formula, _, _ in rows], "-", color=colour, linewidth=1.4)
        some = [(k, row) for k, row in zip(ratios, rows) if RATIOS.index(k) % 2 == 0]
        axes.plot([k for k, _ in some], [row[1] for _, row in some], "o", color=colour, markersize=3.5, label=name)
        deviation.errorbar([k for k, _ in some], [100.0 * (row[1] - row[0]) / row[0] for _, row in some],
                           yerr=[100.0 * row[2] / row[0] for _, row in some], fmt="o", color=colour, markersize=3.0)
    axes.axhline(8.0, color="black", linewidth=0.6)
    axes.annotate("8: spheres, the least", (1.3e-3, 8.0), xytext=(0, -12), textcoords="offset points", fontsize=9)
    axes.set_yscale("log")
    axes.set_ylim(5.0, 4e3)
    axes.set_ylabel("⟨V_ex⟩ / V")
    axes.set_title("Excluded volume of two equal bodies in random orientation", fontsize=12)
    axes.legend(frameon=False, loc="upper center", title="lines: formula; points: Monte Carlo")

    deviation.axhline(0.0, color="black", linewidth=0.6)
    deviation.errorbar([row[0] for row in PAPER], [100.0 * (row[1] - row[3]) / row[3] for row in PAPER],
                       yerr=[100.0 * row[2] / row[3] for row in PAPER], fmt="s", color=ORANGE, markersize=4.5,
                       label="boxes: the Monte Carlo of cond-mat/0207739, 2002")
    deviation.annotate(f"all four bodies: vex, off by {farthest:.2f} % at most", (1.3e-3, 0.0), xytext=(0, 6),
                       textcoords="offset points", fontsize=11)
    deviation.set_ylim(-14.0, 2.6)
    deviation.set_ylabel("Monte Carlo less\nformula, in %")
    deviation.set_xscale("log")
    deviation.set_xlabel("aspect ratio: length along the axis / width")
    deviation.legend(frameon=False, loc="lower right")
    figure.savefig(folder + "/aspect_ratio.svg", metadata={"Date": None})
    plt.close(figure)


if __name__ == "__main__":
    main()
