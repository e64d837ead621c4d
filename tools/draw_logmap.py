#!/usr/bin/env python3
"""Draws docs/figures/logmap.png: the logarithmic map of a point on two scans.

    tools/draw_logmap.py docs/figures/logmap.png --data FOLDER [--tufted build/release/tufted]

FOLDER holds cturtle.pcd and milk_cartoon_all_small_clorox.pcd, two clouds of PCL's test data. Needs python3-matplotlib.
"""
import argparse
import io
import pathlib
import subprocess
import tempfile

import matplotlib
import numpy as np
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from draw_scan import draw  # noqa: E402

SECTORS, RINGS = 24, 12


def chequered(coordinates):
    """Hues by angle, chequered by sectors and rings; grey where no path leads."""
    distance, angle = np.hypot(*coordinates.T), np.arctan2(coordinates[:, 1], coordinates[:, 0])
    reached = np.isfinite(distance)
    turn = np.where(reached, angle, 0) / (2 * np.pi) + 0.5
    rings = np.where(reached, distance, 0) / np.percentile(distance[reached], 95) * RINGS
    colours = 0.35 + 0.6 * plt.cm.hsv(turn)[:, :3]
    colours *= np.where((np.floor(turn * SECTORS) + np.floor(rings)) % 2 == 0, 1, 0.62)[:, None]
    colours[~reached] = 0.75
    return colours


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("target")
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--tufted", default="build/release/tufted")
    options = parser.parse_args()
    figure = plt.figure(figsize=(12, 4.4), facecolor="white")
    scans = [("cturtle", "0,0,2", 20), ("milk_cartoon_all_small_clorox", "0,-0.1,1.05", -20)]
    for place, (name, source, elevation) in enumerate(scans):
        with tempfile.TemporaryDirectory() as folder:

            def tufted(subcommand, *arguments):
                subprocess.run([options.tufted, subcommand, *arguments, "--out", f"{folder}/{subcommand}"], check=True,
                               stdout=subprocess.DEVNULL)
                return lambda array: np.load(f"{folder}/{subcommand}/{array}.npy")

            built = tufted("laplacian", options.data / f"{name}.pcd", "--format", "npz,ply,cover")
            coordinates = tufted("logmap", "--operator", f"{folder}/laplacian", "--near", source)("logmap")
            active = built("status") == 0
            axes = figure.add_axes([0.5 * place, 0, 0.5, 1])
            draw(axes, built("measured_positions")[active], lambda array: built(array)[active],
                 chequered(coordinates[active]), {"azimuth": 180, "elevation": elevation, "distance": 3, "up": 1}, 2)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100)
    Image.open(picture).convert("RGB").quantize(256).save(options.target, optimize=True)


if __name__ == "__main__":
    main()
