"""Shapes for the tests of the package, and where other files are."""
import os
import pathlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("TUFTED_COMMAND", str(ROOT / "build" / "release" / "tufted"))
DATASETS = ROOT / "datasets"


def sphere(count, seed=11, noise=0.0):
    """Random points of the unit sphere."""
    generator = np.random.default_rng(seed)
    points = generator.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return points * (1 + noise * generator.normal(size=(count, 1)))


CLOUD = sphere(3000)


def torus_mesh(n=40, m=20):
    """Vertices and faces of a torus of radii 1 and 0.4."""
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    ring = 1 + 0.4 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")

    def index(a, b):
        return (a % n) * m + b % m

    quads = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]
    quads = np.stack(quads, axis=-1).reshape(-1, 4)
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def same(a, b):
    """Whether two sparse matrices have the same bits."""
    return (np.array_equal(a.data, b.data) and np.array_equal(a.indices, b.indices)
            and np.array_equal(a.indptr, b.indptr))
