#!/usr/bin/env python3
"""Draws docs/figures/spectrum.svg, the figure of README.md and docs/accuracy.md, from what tufted_accuracy prints.

    build/release/tufted_accuracy > docs/figures/spectrum.csv
    tools/plot_spectrum.py docs/figures/spectrum.csv docs/figures/spectrum.svg

The same numbers give the same bytes (with one version of matplotlib). Needs python3-matplotlib.
"""
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

matplotlib.rcParams.update({
    "svg.hashsalt": "tufted",
    "svg.fonttype": "none",  # text stays text
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 11,
})

STYLES = {  # method: label, colour, marker, height of the label in points
    "vertex_pair": ("glued per vertex pair (paper)", "#b8860b", "s", 0),
    "star": ("glued per star (default)", "#1f4e9c", "o", 9),
    "convex_hull": ("cotan of the convex hull", "#777777", "D", -9),
    "poisson": ("Poisson, per star", "#2e7d32", "^", 0),
}


def read(path):
    """Errors by method and number of points, over the seeds."""
    errors = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            errors[row["method"]][int(row["points"])].append(float(row["error"]))
    return errors


def main(source, target):
    errors = read(source)
    figure, axes = plt.subplots(figsize=(8.0, 4.0), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 0.98, 1))  # room for a wider font
    figure.patch.set_facecolor("white")
    for method, (label, colour, marker, shift) in STYLES.items():
        sizes = sorted(errors[method])
        means = [sum(errors[method][n]) / len(errors[method][n]) for n in sizes]
        low = [min(errors[method][n]) for n in sizes]
        high = [max(errors[method][n]) for n in sizes]
        hull = method == "convex_hull"
        axes.fill_between(sizes, low, high, color=colour, alpha=0.25, linewidth=0)
        axes.plot(sizes, means, color=colour, marker=marker, markersize=4 if hull else 6,
                  linewidth=1.4 if hull else 2, linestyle="--" if hull else "-", zorder=3 if hull else 2)
        axes.annotate(label, (sizes[-1], means[-1]), xytext=(10, shift), textcoords="offset points", color=colour,
                      va="center", annotation_clip=False)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(800, 80000)
    axes.set_ylim(1e-4, 1.5e-1)
    axes.set_xticks([1000, 4000, 16000, 64000], ["1,000", "4,000", "16,000", "64,000"])
    axes.set_yticks([1e-4, 1e-3, 1e-2, 1e-1], ["0.01 %", "0.1 %", "1 %", "10 %"])
    axes.minorticks_off()
    axes.grid(True, color="#dddddd", linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel("random points on a sphere")
    axes.set_title("Error of 48 eigenvalues, and of Poisson's equation in L2; mean and range of three samples",
                   loc="left", fontsize=11)
    metadata = {"Date": None, "Creator": None} if target.endswith(".svg") else None
    figure.savefig(target, metadata=metadata, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: plot_spectrum.py IN.csv OUT.svg")
    main(*sys.argv[1:])
