#!/usr/bin/env python3
"""Draws the pictures of lines and maps in docs, by the package for Python:
    PYTHONPATH=build/release/python tools/draw_lines_and_maps.py [FOLDER]
FOLDER is docs/figures by default.
"""
import pathlib
import sys

import numpy as np

import tufted

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "figures"
SEAM = [23, 91, 94, 95, 5, 144, 39, 146, 11, 133, 141, 142, 37]  # as in docs/command.md


def draw(name, surface, values=None, size=(420, 320), **look):
    look = {"camera": (40, 40), "title": "", **look}
    surface.picture(values, size=size, **look).save(FOLDER / f"{name}.png")


def grid(rows, columns, closed):
    """Indices of points in rows, and triangles between them; closed: the last row and column join the first."""
    at = np.arange(rows * columns).reshape(rows, columns)
    if closed:
        at = np.pad(at, ((0, 1), (0, 1)), mode="wrap")
    a, b, c, d = (each.ravel() for each in (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]))
    return at, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def draw_lines():
    long, around = (each.ravel() for each in np.meshgrid(np.arange(96) * np.pi / 48, np.arange(40) * np.pi / 20,
                                                         indexing="ij"))
    radius = 1 + 0.4 * np.cos(around)
    at, faces = grid(96, 40, True)
    torus = tufted.Mesh(np.stack([radius * np.cos(long), radius * np.sin(long), 0.4 * np.sin(around)], axis=1), faces)
    draw("isolines", torus, {"z": torus.points[:, 2]}, isolines=True)
    # A way around the tube that wavers, and the loop to which it is straightened.
    loop = torus.path_through(at[[70, 76, 68, 74], [0, 10, 20, 30]], closed=True)
    draw("loop", torus, line=np.vstack([loop.points, loop.points[:1]]))
    angles = np.linspace(0, 2 * np.pi, 100)
    circle = at[np.round(11 + 8 * np.cos(angles)).astype(int), np.round(5 + 5 * np.sin(angles)).astype(int)]
    draw("signed_distance", torus, {"signed distance": torus.signed_distance(circle[np.diff(circle, prepend=-1) != 0])},
         kind="diverging", isolines=True)


def draw_maps():
    side = np.linspace(0, 1, 60)
    u, v = (each.ravel() for each in np.meshgrid(side, side, indexing="ij"))
    x, y = 2.6 * u - 0.7 * u * v, v + 0.3 * u * v  # without symmetry
    _, faces = grid(60, 60, False)
    flat = tufted.Mesh(np.stack([x, y, 0 * x], axis=1), faces)
    rolled = tufted.Mesh(np.stack([np.sin(x), y, np.cos(x)], axis=1), faces)
    C = tufted.zoom_out(flat, rolled, tufted.functional_map(flat, rolled))
    to_flat = tufted.point_maps(flat, rolled, C).to_source
    draw("maps_source", flat, {"x": x}, camera="top", title="source", light=False)
    draw("maps_target", rolled, {"x": x[to_flat]}, up="y", camera=(50, 25), title="target", light=False)


def draw_cut():
    sphere = tufted.read(ROOT / "datasets" / "icosphere.ply")
    latitude = {"z": sphere.points[:, 2]}
    draw("cut_seam", sphere, latitude, line=sphere.points[SEAM], camera=(20, 10))
    uv = sphere.parameterize(cuts=[SEAM]).uv.reshape(-1, 2)
    places, faces = np.unique(uv, axis=0, return_inverse=True)
    values = np.empty(len(places))
    values[faces.ravel()] = sphere.points[sphere.faces.ravel(), 2]
    plane = tufted.Mesh(np.column_stack([places, np.zeros(len(places))]), faces.reshape(-1, 3))
    draw("cut_map", plane, {"z": values}, camera="top")


def draw_flow():
    # A ball with six arms at the start, after two and after twenty steps.
    ball = tufted.read(ROOT / "datasets" / "icosphere.ply")
    arms = 0.5 + 1.2 * (ball.points ** 6).sum(axis=1)
    body = tufted.Mesh(arms[:, None] * ball.points, ball.faces)
    for steps in (0, 2, 20):
        points = body.mean_curvature_flow(steps=steps) if steps else body.points
        draw(f"flow_{steps}", tufted.Mesh(points, body.faces), {"arms": arms}, camera=(30, 20), size=(280, 280))


if __name__ == "__main__":
    draw_flow()
    draw_lines()
    draw_maps()
    draw_cut()
