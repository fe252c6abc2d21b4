#!/usr/bin/env python3
"""Draws docs/erratum/deficit.svg and docs/erratum/overlooked.svg.

    vex_paper --erratum --trials 5e7 --json erratum.json
    vex_paper --curve --trials 4e6 --json curve.json
    python3 docs/erratum/draw.py erratum.json curve.json docs/erratum

Needs matplotlib (Debian: python3-matplotlib). The pictures are the same bytes for the same numbers and version of it.
"""
import json
import math
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

matplotlib.rcParams.update({
    "svg.hashsalt": "vex", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11,
    "axes.spines.top": False, "axes.spines.right": False,
})
BLUE, ORANGE, GREY = "#1f5fa8", "#c8500a", "#888888"


def percent(row, volume):
    return 100.0 * (row["exact"] - volume) / row["exact"]


def draw_deficit(rows, curve, path):
    """What is missing from <V_ex>, in percent, against the aspect ratio; and how far apart paper and test are."""
    ratios = [row["aspect_ratio"] for row in rows]
    figure, (axes, residuals) = plt.subplots(
        2, 1, figsize=(7.2, 6.0), sharex=True, height_ratios=[3, 1], constrained_layout=True)

    between = [row["aspect_ratio"] for row in curve]
    axes.plot(between, [percent(row, row["excluded_volume"]) for row in curve], "-", color=BLUE, linewidth=1.6,
              label="one-sided test: does an edge of B meet the solid A")
    axes.plot(between, [percent(row, row["tests"]["edges-required-both-ways"]["excluded_volume"]) for row in curve], "--",
              color=GREY, linewidth=1.0, label="another wrong test: edges required both ways")
    axes.errorbar(ratios, [percent(row, row["paper"]) for row in rows],
                  yerr=[100.0 * row["paper_uncertainty"] / row["exact"] for row in rows], fmt="o", color=ORANGE,
                  markersize=5, capsize=4, label="the paper's Monte Carlo, 2002 (one standard error)")
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_ylim(-0.8, 35.0)
    axes.set_ylabel("deficit of ⟨V_ex⟩ in %")
    axes.legend(frameon=False, loc="upper right")
    axes.set_title("Boxes of unit volume, sides l1 and l2 = l3", fontsize=12)

    residuals.axhspan(-2.0, 2.0, color="#e8eef6", linewidth=0)
    residuals.axhline(0.0, color="black", linewidth=0.6)
    residuals.plot(ratios, [row["z"] for row in rows], "o", color=BLUE, markersize=4)
    residuals.set_ylim(-4.0, 4.0)
    residuals.set_ylabel("(test − paper)/σ")
    residuals.set_xscale("log")
    residuals.set_xlabel("aspect ratio l1/l2")
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def rotation(w, x, y, z):
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


CORNERS = [(sx / 2, sy / 2, sz / 2) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
FACES = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
EDGES = [(i, j) for i in range(8) for j in range(i + 1, 8) if bin(i ^ j).count("1") == 1]


def placed(r, t):
    return [tuple(sum(r[i][k] * c[k] for k in range(3)) + t[i] for i in range(3)) for c in CORNERS]


def draw_overlooked(path):
    """Two unit cubes that share points though no edge of B meets A: a corner of A is in B, through a face of B."""
    identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    # The quaternion turns A's corner (-1, -1, -1)/2 straight down.
    half = 0.5 * math.acos(1.0 / math.sqrt(3.0))
    s = math.sin(half) / math.sqrt(2.0)
    r = rotation(math.cos(half), -s, s, 0.0)
    bodies = [("B", placed(identity, (0.0, 0.0, 0.0)), BLUE),
              ("A", placed(r, (0.05, 0.0, 0.5 + math.sqrt(3.0) / 2.0 - 0.3)), ORANGE)]
    figure = plt.figure(figsize=(5.2, 5.2))
    axes = figure.add_axes([-0.05, -0.05, 1.1, 1.1], projection="3d", proj_type="ortho")
    for name, points, colour in bodies:
        axes.add_collection3d(Poly3DCollection([[points[i] for i in face] for face in FACES], facecolor=colour,
                                               alpha=0.10, edgecolor="none"))
        axes.add_collection3d(Line3DCollection([[points[i] for i in edge] for edge in EDGES], colors=colour,
                                               linewidths=1.4))
    # The parts of A's edges that are inside B: from its lowest corner to B's upper face.
    points = bodies[1][1]
    lowest = min(range(8), key=lambda i: points[i][2])
    inside = []
    for i, j in EDGES:
        if lowest not in (i, j):
            continue
        p, q = points[lowest], points[j if i == lowest else i]
        f = (0.5 - p[2]) / (q[2] - p[2])
        inside.append([p, tuple(p[k] + f * (q[k] - p[k]) for k in range(3))])
    axes.add_collection3d(Line3DCollection(inside, colors="black", linewidths=3.0))
    face = [line[1] for line in inside]
    axes.add_collection3d(Poly3DCollection([face], facecolor="black", alpha=0.25, edgecolor="black", linewidths=0.8))
    axes.text(0.62, -0.5, -0.35, "B", color=BLUE, fontsize=14)
    axes.text(0.62, 0.3, 1.75, "A", color=ORANGE, fontsize=14)
    axes.set_xlim(-0.75, 0.75)
    axes.set_ylim(-0.75, 0.75)
    axes.set_zlim(-0.5, 1.9)
    axes.set_box_aspect((1.5, 1.5, 2.4), zoom=1.02)
    axes.view_init(elev=18, azim=-62)
    axes.set_axis_off()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def rows_of(path, part):
    with open(path, encoding="utf-8") as file:
        return json.load(file)[part]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    erratum, curve, folder = sys.argv[1:]
    draw_deficit(rows_of(erratum, "erratum"), rows_of(curve, "curve"), folder + "/deficit.svg")
    draw_overlooked(folder + "/overlooked.svg")


if __name__ == "__main__":
    main()
