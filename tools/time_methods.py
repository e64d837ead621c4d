#!/usr/bin/env python3
"""Prints how long the methods of the Python package take on a mesh, in processor seconds of one thread:
    PYTHONPATH=build/release/python python3 tools/time_methods.py MESH
MESH is closed and in one piece. The functional map and its points are also computed by pyFM's formulas, as
tests/python/test_maps_beside_pyfm.py has them.
"""
import pathlib
import sys
import time

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

import tufted

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "python"))
from test_maps_beside_pyfm import Theirs, their_functional_map, their_points  # noqa: E402


def seconds(call):
    """The processor time of a call, and its result."""
    start = time.process_time()
    result = call()
    return time.process_time() - start, result


def row(name, call, again=None):
    """Prints the time of a call, and that of a further one, which reuses what the first one has prepared."""
    first, result = seconds(call)
    further = seconds(again)[0] if again else None
    print(f"| {name} | {first:.2f} | {'' if further is None else f'{further:.3f}'} |", flush=True)
    return result


def seam(mesh, start, end):
    """A path along edges of the mesh."""
    i, j = tufted.edges(mesh.points, mesh.faces).T
    graph = coo_matrix((np.linalg.norm(mesh.points[i] - mesh.points[j], axis=1), (i, j)), shape=2 * [len(mesh)])
    _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    path = [end]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    return path


def main(file):
    points, faces = tufted.read_mesh(file)
    mesh = row("`Mesh`", lambda: tufted.Mesh(points, faces, threads=1))
    height = points[:, 1] - (points[:, 1].max() + points[:, 1].min()) / 2
    size, top, low = np.ptp(points[:, 1]), int(height.argmax()), int(height.argmin())
    landmarks = mesh.segments(100).seeds
    line = max(mesh.isolines(height, 0), key=lambda each: each.length)
    around = mesh.nearest(line.points[::max(1, len(line.points) // 5)])
    curve = seam(mesh, *mesh.nearest(line.points[[0, len(line.points) // 3]]))
    print("| method | first call | further call |\n|---|---|---|")
    row("`distance` by marching", lambda: mesh.distance(top), lambda: mesh.distance(low))
    row("`distance_matrix`, 100 landmarks", lambda: mesh.distance_matrix(landmarks))
    row("`distance` by heat", lambda: mesh.distance(top, method="heat"), lambda: mesh.distance(low, method="heat"))
    row("`trace` over half of the height", lambda: mesh.trace(top, [1, 0, 0], size / 2),
        lambda: mesh.trace(low, [1, 0, 0], size / 2))
    row("`isolines`, ten heights", lambda: mesh.isolines(height, np.linspace(-0.45, 0.45, 10) * size))
    row("`path` from top to bottom", lambda: mesh.path(top, low), lambda: mesh.path(low, top))
    row(f"`path_through`, a loop through {len(around)} points", lambda: mesh.path_through(around, closed=True),
        lambda: mesh.path_through(around[::-1], closed=True))
    for method in ("heat", "marching"):
        row(f"`signed_distance` by {method}, a curve of {len(curve)} points",
            lambda: mesh.signed_distance(curve, method=method), lambda: mesh.signed_distance(curve, method=method))
    for method in ("exact", "heat"):
        row(f"`log_map`, {method}", lambda: mesh.log_map(top, method=method), lambda: mesh.log_map(low, method=method))
    row("`transport`", lambda: mesh.transport(top, [1, 0, 0]), lambda: mesh.transport(low, [1, 0, 0]))
    row("`extend`", lambda: mesh.extend([top, low], [0, 1]), lambda: mesh.extend([top, low], [1, 0]))
    row("`mean_curvature_flow`, ten steps", lambda: mesh.mean_curvature_flow(steps=10))
    row("`parameterize` with a cut from top to bottom",
        lambda: mesh.parameterize(method="harmonic", weights="mean-value", cuts=[seam(mesh, top, low)]))
    row("`picture`", lambda: mesh.picture(height))
    row("`page`", lambda: mesh.page(height))
    bent = points + np.outer(0.1 * size * np.sin(height * np.pi / size), [1, 0, 0])
    other = tufted.Mesh(bent, faces, threads=1)
    row("`spectrum`, 100 pairs of two shapes", lambda: (mesh.spectrum(100), other.spectrum(100)))
    C = row("`functional_map`", lambda: tufted.functional_map(mesh, other))
    row("`zoom_out` from 30 to 100 pairs", lambda: tufted.zoom_out(mesh, other, C))
    row("`point_maps` of 30 pairs, both ways", lambda: tufted.point_maps(mesh, other, C))
    one, two = Theirs(mesh), Theirs(other)
    C = row("pyFM's formula of a functional map, 50 pairs", lambda: their_functional_map(one, two))
    two.vectors = two.vectors[::17]
    row("its points of 30 pairs by cKDTree, every 17th, one way", lambda: their_points(one, two, C[:30, :30]))


if __name__ == "__main__":
    main(sys.argv[1])
