#!/usr/bin/env python3
"""Draws docs/figures/scan.png: geodesic distances on the scan of a building, and two eigenvectors on a bunny.

    tools/draw_scan.py docs/figures/scan.png [--tufted build/release/tufted] [--data FOLDER]

FOLDER is what tools/fetch_samples.sh prints (the default): the sample data of Debian's libcgal-demo. The building is a
scan of 100,000 points, the bunny the vertices of bunny00.off, taken as a cloud. Needs python3-matplotlib.
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
from matplotlib.colors import LinearSegmentedColormap  # noqa: E402

WIDTH, HEIGHT = 1200, 400  # pixels
LIGHT = np.array([-0.32, 0.49, 0.81])  # towards the light: left, above, behind the eye
DIVERGING = LinearSegmentedColormap.from_list(
    "diverging", ["#14366f", "#2f6fb3", "#93bfdc", "#f4f1ea", "#eda57d", "#c94a3a", "#7a1428"])
SEQUENTIAL = LinearSegmentedColormap.from_list("sequential", ["#fbeecb", "#f4bd8a", "#dd6b4f", "#a23b6b", "#4f3a86"])


def points_of(path):
    """The vertices of an OFF or ASCII PLY file."""
    lines = path.read_text(errors="replace").splitlines()
    if lines[0] == "ply":
        count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
        first = lines.index("end_header") + 1
    else:
        count, first = int(" ".join(lines[:2]).split()[1]), 2
    return np.array([line.split()[:3] for line in [line for line in lines[first:] if line][:count]], dtype=float)


def camera(points, azimuth, elevation, distance, up):
    """Screen coordinates and depth towards the eye of a perspective view, and the matrix of the turn."""
    points = np.roll(points, 1 - up, axis=1)  # now y is up
    a, e = np.radians([azimuth, elevation])
    turn = np.array([[1, 0, 0], [0, np.cos(e), -np.sin(e)], [0, np.sin(e), np.cos(e)]]) @ np.array(
        [[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    low, high = points.min(axis=0), points.max(axis=0)
    seen = (points - (low + high) / 2) / np.linalg.norm(high - low) @ turn.T
    scale = 1 / (distance - seen[:, 2])
    return seen[:, :2] * scale[:, None], seen[:, 2], scale, lambda v: np.roll(v, 1 - up, axis=1) @ turn.T


def draw(axes, points, built, colours, view, size):
    """Points as lit discs, far ones first; `size` is that of the median area."""
    place, depth, scale, turn = camera(points, **view)
    normals = turn(built("frames")[:, 2])
    normals *= np.where(normals[:, 2:] < 0, -1, 1)  # both sides are lit
    lambert = np.clip(normals @ LIGHT, 0, 1)
    shine = np.clip(normals @ ((LIGHT + [0, 0, 1]) / np.linalg.norm(LIGHT + [0, 0, 1])), 0, 1) ** 40
    lit = np.clip(colours[:, :3] * (0.35 + 0.70 * lambert)[:, None] + 0.15 * shine[:, None], 0, 1)
    area = built("M")
    size = size * np.clip(area / np.median(area), 0.7, 4) * (scale / scale.mean()) ** 2
    order = np.argsort(depth)
    axes.scatter(*place[order].T, s=size[order], c=lit[order], linewidths=0)
    axes.set_aspect("equal")
    axes.axis("off")


def isolines(distance, count):
    """Colours by distance, with a dark line at every of `count` steps; grey where no path leads."""
    reached = np.isfinite(distance)
    share = np.where(reached, distance, 0) / distance[reached].max()
    colours = SEQUENTIAL(share)[:, :3]
    nearness = np.abs((share * count) % 1 - 0.5) * 2  # 1 at a line
    colours *= 1 - 0.55 * np.clip((nearness - 0.84) / 0.08, 0, 1)[:, None]
    colours[~reached] = 0.75
    return colours


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("target")
    parser.add_argument("--tufted", default="build/release/tufted")
    parser.add_argument("--data", type=pathlib.Path)
    options = parser.parse_args()
    if options.data is None:
        fetch = pathlib.Path(__file__).with_name("fetch_samples.sh")
        options.data = pathlib.Path(subprocess.check_output([fetch], text=True).strip())

    figure = plt.figure(figsize=(WIDTH / 100, HEIGHT / 100), facecolor="white")
    with tempfile.TemporaryDirectory() as folder:

        def tufted(subcommand, *arguments):
            subprocess.run([options.tufted, subcommand, *arguments, "--out", f"{folder}/{subcommand}"], check=True,
                           stdout=subprocess.DEVNULL)
            return lambda name: np.load(f"{folder}/{subcommand}/{name}.npy")

        building = options.data / "points_3" / "building.ply"
        built = tufted("laplacian", building, "--format", "npz,cover")
        distance = tufted("distance", "--operator", f"{folder}/laplacian", "--source", "3446")("distance")
        axes = figure.add_axes([0, 0, 0.44, 1])
        draw(axes, points_of(building), built, isolines(distance, 18),
             {"azimuth": 142, "elevation": 24, "distance": 1.7, "up": 2}, 4)

        bunny = options.data / "meshes" / "bunny00.off"
        built = tufted("laplacian", bunny, "--as", "cloud")
        vectors = tufted("spectrum", "--operator", f"{folder}/laplacian", "--count", "12")("evecs")
        for place, column in enumerate([3, 7]):
            axes = figure.add_axes([0.45 + 0.275 * place, 0, 0.27, 1])
            values = vectors[:, column]
            draw(axes, points_of(bunny), built, DIVERGING(0.5 + 0.5 * np.tanh(1.6 * values / np.abs(values).max())),
                 {"azimuth": 20, "elevation": 12, "distance": 3, "up": 1}, 16)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100)
    Image.open(picture).convert("RGB").quantize(256).save(options.target, optimize=True)  # a third of the bytes


if __name__ == "__main__":
    main()
