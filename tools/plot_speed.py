#!/usr/bin/env python3
"""Prints a table of speed and draws a figure, from files that tufted_bench writes.

    mkdir -p out/speed
    for case in $(build/release/tufted_bench --benchmark_list_tests --benchmark_filter='/sphere/.*/(clean|scan)/threads:1/'); do
      build/release/tufted_bench --benchmark_filter="$case" --benchmark_out="out/speed/$(echo "$case" | tr / _).json"
    done
    tools/plot_speed.py out/speed/*.json docs/figures/speed.svg

Each case has a process of its own here, as what others leave behind counts in its peak. The same numbers give the same bytes (with
one version of matplotlib). Needs python3-matplotlib.
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

matplotlib.rcParams.update({
    "svg.hashsalt": "tufted",
    "svg.fonttype": "none",  # text stays text
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 11,
})

LINES = {  # preset: label, colour, marker
    "scan": ("whole build, --preset scan (default)", "#b8860b", "s"),
    "clean": ("whole build, --preset clean", "#1f4e9c", "o"),
    "flann": ("FLANN's search alone", "#777777", "D"),
}


def read(paths):
    """Benchmarks of clouds on one thread by (cloud, preset)."""
    runs = []
    for path in paths:
        with open(path) as file:
            runs += json.load(file)["benchmarks"]
    cases = {}
    for run in runs:
        parts = run["name"].split("/")
        if parts[0] != "cloud" or run.get("run_type") == "aggregate" or "whole_per_flann" not in run:
            continue
        end = next(i for i, part in enumerate(parts) if part.startswith("threads:"))
        start = next(i for i, part in enumerate(parts) if part in ("clean", "scan", "lidar"))
        cases["/".join(parts[1:start]), "/".join(parts[start:end])] = run
    return cases


def print_table(cases):
    print("| cloud | steps | s | times FLANN | bytes per point | frames/s |")
    print("|---|---|---|---|---|---|")
    for (cloud, steps), run in cases.items():
        print(f"| {cloud} | {steps} | {run['s:whole']:.3g} | {run['whole_per_flann']:.2f} "
              f"| {run['peak_B_per_item']:.0f} | {run['frames_per_second']:.3g} |")


def draw(cases, target):
    figure, axes = plt.subplots(figsize=(8.0, 4.0), layout="constrained")
    figure.patch.set_facecolor("white")
    spheres = {(int(cloud.split("/")[1]), steps): run for (cloud, steps), run in cases.items()
               if cloud.startswith("sphere/")}
    for line, (label, colour, marker) in LINES.items():
        points = [(n, run["s:flann" if line == "flann" else "s:whole"] / n * 1e6)
                  for (n, steps), run in sorted(spheres.items()) if steps == ("clean" if line == "flann" else line)]
        if points:
            axes.plot(*zip(*points), color=colour, marker=marker, linewidth=2, label=label)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("points, random on a sphere")
    axes.set_ylabel("microseconds per point, one thread")
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.legend(frameon=False)
    figure.savefig(target, metadata={"Date": None})


def main(*paths):
    *sources, target = paths
    cases = read(sources)
    print_table(cases)
    draw(cases, target)


if __name__ == "__main__":
    main(*sys.argv[1:])
