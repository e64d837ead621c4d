#!/usr/bin/env python3
"""Draws docs/figures/segments.png: parts of an elephant, and of boxes on a table in a depth image.

    tools/draw_segments.py docs/figures/segments.png --data FOLDER [--samples FOLDER] [--tufted build/release/tufted]

The first FOLDER holds mosd_learn0.pcd, a cloud of PCL's test data; the second is what tools/fetch_samples.sh prints (the
default). Needs python3-matplotlib.
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


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("target")
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--samples", type=pathlib.Path)
    parser.add_argument("--tufted", default="build/release/tufted")
    options = parser.parse_args()
    if options.samples is None:
        fetch = pathlib.Path(__file__).with_name("fetch_samples.sh")
        options.samples = pathlib.Path(subprocess.check_output([fetch], text=True).strip())
    elephant = {"azimuth": 30, "elevation": 10, "distance": 3, "up": 1}
    table = {"azimuth": 180, "elevation": -25, "distance": 3, "up": 1}
    drawings = [(options.samples / "meshes" / "elephant.off", ["--method", "spectral", "--count", "8"], elephant, 14),
                (options.data / "mosd_learn0.pcd", ["--method", "spectral", "--count", "5"], table, 2),
                (options.data / "mosd_learn0.pcd", ["--count", "7"], table, 2)]
    figure = plt.figure(figsize=(12, 4), facecolor="white")
    for place, (path, arguments, view, size) in enumerate(drawings):
        with tempfile.TemporaryDirectory() as folder:

            def tufted(subcommand, *extra):
                subprocess.run([options.tufted, subcommand, *extra, "--out", f"{folder}/{subcommand}"], check=True,
                               stdout=subprocess.DEVNULL)
                return lambda array: np.load(f"{folder}/{subcommand}/{array}.npy")

            built = tufted("laplacian", path, "--as", "cloud", "--format", "npz,ply,cover")
            labels = tufted("segment", "--operator", f"{folder}/laplacian", *arguments)("labels")
            active = built("status") == 0
            axes = figure.add_axes([place / 3, 0, 1 / 3, 1])
            draw(axes, built("measured_positions")[active], lambda array: built(array)[active],
                 plt.cm.tab20(labels[active] % 20)[:, :3], view, size)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100)
    Image.open(picture).convert("RGB").quantize(256).save(options.target, optimize=True)


if __name__ == "__main__":
    main()
