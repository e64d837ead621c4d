"""Maps between shapes beside the formulas of pyFM (Magnet, https://github.com/RobinMagnet/pyFM), written anew here from
their definition, as pyFM cannot be installed everywhere. Both have the same eigenpairs. `python3
tests/python/test_maps_beside_pyfm.py` prints the table of docs/tables/maps_and_edits.md.
"""
import numpy as np
import pytest
from scipy.spatial import Delaunay, cKDTree
from test_maps import CORNERS, body, clouds, flat, pushed_in, rolled, triangle_mesh, triangle_sample

import tufted

# Defaults of pyFM: eigenpairs, descriptors, and weights of descriptors, Laplacian and multiplications.
PAIRS, ENERGIES, OF_DESCRIPTORS, OF_LAPLACIAN, OF_MULTIPLICATIONS = 50, 100, 0.1, 1e-3, 1


class Theirs:
    """A shape of area 1 with its first eigenpairs."""

    def __init__(self, surface, k=100):
        area = surface.M.sum()
        values, vectors = surface.spectrum(k)
        self.values, self.vectors, self.areas = values * area, vectors * np.sqrt(area), surface.M / area

    def descriptors(self, landmarks):
        """Wave kernel signatures, and those around landmarks, of norm 1, from the first pairs."""
        values, vectors = self.values[1:PAIRS], self.vectors[:, 1:PAIRS]
        low, high = np.log(values[[0, -1]])
        width = 7 * (high - low) / ENERGIES
        energies = np.linspace(low + 2 * width, high - 2 * width, ENERGIES)
        waves = np.exp(-(energies - np.log(values)[:, None])**2 / (2 * width**2))
        waves /= waves.sum(axis=0)
        found = np.hstack([vectors**2 @ waves, *(vectors * vectors[place] @ waves for place in landmarks)])
        return found / np.sqrt(self.areas @ found**2)

    def coefficients(self, functions):
        return self.vectors[:, :PAIRS].T @ (self.areas[:, None] * functions)

    def multiplications(self, functions):
        """For each function the matrix that multiplies coefficients by it."""
        basis = self.vectors[:, :PAIRS]
        return np.array([basis.T @ ((self.areas * each)[:, None] * basis) for each in functions.T])


def their_functional_map(first, second, landmarks=()):
    """C that minimises the three terms with the constants on each other, which is a linear system in its entries."""
    pairs = np.reshape(landmarks, (-1, 2)).astype(int)
    functions = [shape.descriptors(places) for shape, places in zip((first, second), pairs.T)]
    A, B = (shape.coefficients(each) for shape, each in zip((first, second), functions))
    of_first, of_second = (shape.multiplications(each) for shape, each in zip((first, second), functions))
    squares = (first.values[:PAIRS] - second.values[:PAIRS, None])**2
    one, k = np.eye(PAIRS), PAIRS
    # Entries of C row by row: C A is (1 x A^T) C, and B C is (B x 1) C.
    system = OF_DESCRIPTORS * np.kron(one, A @ A.T) + OF_LAPLACIAN * np.diag(squares.ravel() / squares.sum())
    system += OF_MULTIPLICATIONS * np.kron(one, np.einsum("dij,dkj->ik", of_first, of_first))
    system += OF_MULTIPLICATIONS * np.kron(np.einsum("dji,djk->ik", of_second, of_second), one)
    crossed = of_second.reshape(-1, k * k).T @ of_first.reshape(-1, k * k)
    system -= 2 * OF_MULTIPLICATIONS * crossed.reshape(k, k, k, k).transpose(0, 2, 1, 3).reshape(k * k, k * k)
    right = OF_DESCRIPTORS * (B @ A.T).ravel()
    C = np.zeros((k, k))
    C[0, 0] = np.sign(first.vectors[0, 0] * second.vectors[0, 0])
    free = np.arange(k * k).reshape(k, k)[:, 1:].ravel()
    C.ravel()[free] = np.linalg.solve(system[np.ix_(free, free)], right[free] - system[free, 0] * C[0, 0])
    return C


def their_points(first, second, C):
    """For each point of the second shape one of the first: the nearest after C brings the first to the second."""
    k = len(C)
    return cKDTree(first.vectors[:, :k] @ C.T).query(second.vectors[:, :k])[1]


def their_zoom_out(first, second, C, k=100):
    while len(C) < k:
        points, size = their_points(first, second, C), len(C) + 1
        C = second.vectors[:, :size].T @ (second.areas[:, None] * first.vectors[points, :size])
    return C


def compared(a, b, first, second, landmarks=()):
    """Errors of the points of b as shares of the root of the area: functional map and refined, theirs and ours."""
    mine, other = Theirs(a), Theirs(b)
    theirs = their_functional_map(mine, other, landmarks)
    ours = tufted.functional_map(a, b, landmarks=landmarks)
    points = [their_points(mine, other, C) for C in (theirs, their_zoom_out(mine, other, theirs))]
    points += [tufted.point_maps(a, b, C).to_source for C in (ours, tufted.zoom_out(a, b, ours))]
    found = [np.linalg.norm(first[each] - second, axis=1).mean() / np.sqrt(a.M.sum()) for each in points]
    return np.array(found)[[0, 2, 1, 3]]


def other_vertices(seed):
    """Meshes of the triangle and of the rolled one with 2,000 vertices of their own, some of them along the sides, as
    long edges would leave the rolled triangle.
    """
    sides = [np.linspace(a, b, 50 + 7 * (k == 1), endpoint=False) for k in range(2)
             for a, b in zip(CORNERS, np.roll(CORNERS, -1, axis=0))]
    uv = [np.vstack([*sides[3 * k:3 * k + 3], triangle_sample(2000, seed + 100 * k)])[:2000] for k in range(2)]
    shapes = [tufted.Mesh(place(each), Delaunay(each).simplices) for place, each in zip((flat, rolled), uv)]
    return *shapes, *uv


def marked(first, second):
    """Five pairs of corresponding points."""
    places = np.linspace(0, len(first) - 1, 5).astype(int)
    return [(i, np.linalg.norm(second - first[i], axis=1).argmin()) for i in places]


@pytest.fixture(scope="module")
def meshes():
    uv, faces = triangle_mesh(50)
    return uv, tufted.Mesh(flat(uv), faces), tufted.Mesh(3 * rolled(uv), faces)


def test_theirs_is_the_least_of_their_cost(meshes):
    """The system of equations of their_functional_map is that of the three terms."""
    first, second = map(Theirs, meshes[1:])
    functions = [shape.descriptors(()) for shape in (first, second)]
    A, B = (shape.coefficients(each) for shape, each in zip((first, second), functions))
    of_first, of_second = (shape.multiplications(each) for shape, each in zip((first, second), functions))
    squares = (first.values[:PAIRS] - second.values[:PAIRS, None])**2

    def cost(C):
        return (OF_DESCRIPTORS * ((C @ A - B)**2).sum() + OF_LAPLACIAN * (squares * C**2).sum() / squares.sum()
                + OF_MULTIPLICATIONS * ((C @ of_first - of_second @ C)**2).sum())

    C, random = their_functional_map(first, second), np.random.default_rng(1)
    for _ in range(5):
        step = 1e-3 * random.normal(size=C.shape)
        step[:, 0] = 0
        assert abs(cost(C + step) - cost(C - step)) < 1e-9 < cost(C + step) - cost(C)


def test_functional_maps_agree_on_a_rolled_mesh(meshes):
    _, first, second = meshes
    theirs = their_functional_map(Theirs(first), Theirs(second))[:30, :30]
    ours = tufted.functional_map(first, second)
    np.testing.assert_array_equal(np.sign(np.diag(ours)), np.sign(np.diag(theirs)))
    assert abs(ours - theirs).max() < 0.1


def test_zoom_out_is_theirs_on_a_rolled_mesh(meshes):
    _, first, second = meshes
    start = tufted.functional_map(first, second, k=20)
    ours = tufted.zoom_out(first, second, start, k=24, samples=None)
    # Ours fits by least squares of points, theirs by sums over areas.
    np.testing.assert_allclose(ours, their_zoom_out(Theirs(first), Theirs(second), start, 24), atol=1e-3)


@pytest.mark.parametrize("seed", [101, 102])
def test_refined_maps_with_landmarks_differ_by_less_than_half_a_spacing(seed):
    first, second = body(2000, seed), body(2000, seed + 100)
    found = compared(*clouds(first, pushed_in(second)), first, second, marked(first, second))
    assert abs(found[3] - found[2]) < 0.5 / np.sqrt(2000)


def main():
    print("| pair | functional map, pyFM | ours | refined, pyFM | ours |\n|---|---|---|---|---|")
    uv, faces = triangle_mesh(50)
    report("triangle of 1,326 vertices, rolled up",
           [(tufted.Mesh(flat(uv), faces), tufted.Mesh(rolled(uv), faces), uv, uv)])
    report("the same, meshes of 2,000 other vertices", map(other_vertices, range(101, 106)))
    pairs = [(triangle_sample(2000, seed), triangle_sample(2000, seed + 100)) for seed in range(101, 106)]
    report("the same, samples of 2,000 points", [(*clouds(flat(a), rolled(b)), a, b) for a, b in pairs])
    pairs = [(body(2000, seed), body(2000, seed + 100)) for seed in range(101, 106)]
    report("body with a side pushed in, samples of 2,000 points",
           [(*clouds(a, pushed_in(b)), a, b) for a, b in pairs])
    report("the same with five landmarks", [(*clouds(a, pushed_in(b)), a, b, marked(a, b)) for a, b in pairs])


def report(name, pairs):
    found = np.mean([compared(*pair) for pair in pairs], axis=0)
    print(f"| {name} | " + " | ".join(f"{100 * error:.1f} %" for error in found) + " |", flush=True)


if __name__ == "__main__":
    main()
