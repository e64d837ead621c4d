"""Maps between shapes, on pairs whose answer is known: a triangle without symmetry and the same one rolled up, and a
body of which one side is pushed in, mirrored at a plane. Both keep all lengths along the surface.
"""
import numpy as np
import pytest

import tufted

CORNERS = np.array([[0, 0], [2.6, 0.2], [0.7, 1.7]])


def rolled(uv, radius=0.8):
    return np.stack([radius * np.sin(uv[:, 0] / radius), uv[:, 1], radius * np.cos(uv[:, 0] / radius)], axis=1)


def flat(uv):
    return np.stack([uv[:, 0], uv[:, 1], 0 * uv[:, 0]], axis=1)


def triangle_mesh(m):
    """Vertices and faces of a triangle whose sides are cut into m."""
    i, j = np.array([(i, j) for i in range(m + 1) for j in range(m + 1 - i)]).T
    number = np.full((m + 2, m + 2), -1)
    number[i, j] = np.arange(len(i))
    up, down = i + j < m, i + j < m - 1
    faces = [(number[i[up], j[up]], number[i[up] + 1, j[up]], number[i[up], j[up] + 1]),
             (number[i[down] + 1, j[down]], number[i[down] + 1, j[down] + 1], number[i[down], j[down] + 1])]
    return (CORNERS[0] + np.outer(i, CORNERS[1] - CORNERS[0]) / m + np.outer(j, CORNERS[2] - CORNERS[0]) / m,
            np.concatenate([np.stack(part, axis=1) for part in faces]))


def triangle_sample(count, seed):
    shares = np.random.default_rng(seed).dirichlet([1, 1, 1], count)
    return shares @ CORNERS


def body(count, seed):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    x, y, z = points.T
    return points * (1 + 0.25 * x * y + 0.2 * x**3 + 0.15 * z * y**2 + 0.2 * y)[:, None] * [1.3, 1, 0.9]


def pushed_in(points, height=0.5):
    return np.stack([points[:, 0], points[:, 1], height - abs(points[:, 2] - height)], axis=1)


def errors(maps, first, second, area):
    """Mean distances of points from where their image lies, both ways, in units of the square root of the area."""
    return (np.linalg.norm(second[maps.to_target] - first, axis=1).mean() / np.sqrt(area),
            np.linalg.norm(first[maps.to_source] - second, axis=1).mean() / np.sqrt(area))


@pytest.fixture(scope="module")
def meshes():
    uv, faces = triangle_mesh(50)
    return uv, tufted.Mesh(flat(uv), faces), tufted.Mesh(3 * rolled(uv), faces)


def test_a_rolled_mesh_is_mapped_vertex_by_vertex(meshes):
    uv, first, second = meshes
    C = tufted.functional_map(first, second)
    np.testing.assert_allclose(abs(C), np.eye(30), atol=0.1)
    refined = tufted.zoom_out(first, second, C)
    assert refined.shape == (100, 100)
    np.testing.assert_array_equal(tufted.point_maps(first, second, refined), [np.arange(len(uv))] * 2)


@pytest.mark.parametrize("seed", [101, 102])
def test_samples_of_both_shapes_are_mapped_within_two_spacings(seed):
    """Different points, so that the nearest right one is itself half a spacing away; measured 0.026 to 0.032."""
    first, second = triangle_sample(2000, seed), triangle_sample(2000, seed + 100)
    clouds = tufted.PointCloud(flat(first), "clean"), tufted.PointCloud(rolled(second), "clean")
    maps = tufted.point_maps(*clouds, tufted.zoom_out(*clouds, tufted.functional_map(*clouds)))
    assert max(errors(maps, first, second, 2.1)) < 2 / np.sqrt(2000)


def test_landmarks_make_up_for_poor_descriptors():
    first, second = body(2000, 101), body(2000, 102)
    clouds = tufted.PointCloud(first, "clean"), tufted.PointCloud(pushed_in(second), "clean")
    places = np.arange(0, 2000, 400)
    landmarks = [(i, np.linalg.norm(second - first[i], axis=1).argmin()) for i in places]
    maps = tufted.point_maps(*clouds, tufted.zoom_out(*clouds, tufted.functional_map(*clouds, landmarks=landmarks)))
    assert max(errors(maps, first, second, clouds[0].M.sum())) < 1.5 / np.sqrt(2000)


def test_each_row_minimises_its_cost(meshes):
    """The gradient of the cost of the map is zero at it: no other C does better."""
    _, first, second = meshes
    random = np.random.default_rng(1)
    descriptors = [np.abs(random.normal(size=(len(first), 40))) for _ in range(2)]
    weights, k, mu = random.uniform(size=40), 12, 0.03
    C = tufted.functional_map(first, second, descriptors, weights=weights, k=k, commutativity=mu)
    parts = []
    for surface, functions in zip((first, second), descriptors):
        values, vectors = surface.spectrum(100)
        norms = np.sqrt(surface.M @ functions**2)
        parts.append(((vectors.T * surface.M @ (functions / norms))[:k], values[:k] * surface.M.sum()))
    (A, D), (B, E) = parts
    scale = max(D[-1], E[-1])

    def cost(C):
        return (weights / 40 * (C @ A - B)**2).sum() + mu * ((C * D - E[:, None] * C)**2).sum() / scale**2

    least = cost(C)
    for _ in range(20):
        step = 1e-3 * random.normal(size=C.shape)
        assert cost(C + step) > least and cost(C - step) > least
        assert abs(cost(C + step) - cost(C - step)) < 1e-9


def test_zoom_out_starts_from_points_too(meshes):
    uv, first, second = meshes
    start = np.arange(len(uv))
    start[::3] = -1
    maps = tufted.point_maps(first, second, tufted.zoom_out(first, second, start, k=60, samples=None))
    np.testing.assert_array_equal(maps.to_source, np.arange(len(uv)))


def test_a_larger_start_is_returned_as_it_is(meshes):
    C = np.random.default_rng(1).normal(size=(12, 12))
    np.testing.assert_array_equal(tufted.zoom_out(*meshes[1:], C, k=9), C)


@pytest.mark.parametrize("stage, call", [
    ("functional map", lambda a, b, progress: tufted.functional_map(a, b, progress=progress)),
    ("refine map", lambda a, b, progress: tufted.zoom_out(a, b, np.eye(30), progress=progress)),
    ("map", lambda a, b, progress: tufted.point_maps(a, b, np.eye(30), progress=progress))])
def test_maps_stop_when_told(meshes, stage, call):
    with pytest.raises(tufted.Cancelled, match=f"during {stage}$"):
        call(*meshes[1:], lambda now, fraction: now != stage)


def test_points_that_take_no_part_have_no_image():
    uv = triangle_sample(800, 101)
    points = np.vstack([rolled(uv), [[np.nan] * 3, [50, 50, 50]], rolled(uv[:1])])
    first, second = tufted.PointCloud(flat(uv)), tufted.PointCloud(points)
    maps = tufted.point_maps(first, second, tufted.functional_map(first, second, k=20))
    np.testing.assert_array_equal(maps.to_source[[800, 801]], [-1, -1])
    assert maps.to_source[802] == maps.to_source[0] and maps.to_target.max() < 800


def test_signatures_of_two_shapes_compare_only_at_the_same_scales(meshes):
    _, first, second = meshes
    here = first.wks(k=60)
    assert here.shape == (len(first), 100) and here.times is None and len(here.energies) == 100
    with pytest.raises(tufted.InvalidInput, match="signatures at different times or energies"):
        tufted.functional_map(first, second, (here, second.wks(k=60)))
    with pytest.raises(tufted.InvalidInput, match="signatures at different times or energies"):
        tufted.functional_map(first, second, (first.hks(k=60), second.hks(k=60)))
    heat = first.hks(k=60)
    there = second.hks(9 * heat.times, k=60)  # lengths are three times as large
    np.testing.assert_allclose(heat, 9 * there, rtol=0.02)
    expected = tufted.functional_map(first, second, (heat, there))  # at scales that correspond
    for pair in ((np.asarray(heat), np.asarray(there)), (heat, np.asarray(there))):
        np.testing.assert_array_equal(tufted.functional_map(first, second, pair), expected)
    waves = second.wks(here.energies - np.log(9), width=here.width, k=60)
    assert tufted.functional_map(first, second, (here, waves)).shape == (30, 30)
    for other in (second.wks(here.energies, width=2 * here.width, k=60), waves[:, :50], heat):
        with pytest.raises(tufted.InvalidInput, match="signatures at different|descriptors have 100 and 50 columns"):
            tufted.functional_map(first, second, (here, other))
    np.testing.assert_array_equal(first.wks(here.energies, width=here.width, k=60), here)


def test_results_of_arithmetic_with_signatures_are_plain(meshes):
    heat = meshes[1].hks(k=20)
    assert heat[:, :3].times is None and heat.copy().times is None
    for plain in (heat + 1, heat.sum(axis=0), np.log(heat)):
        assert type(plain) is np.ndarray
    for number in (heat.max(), heat.sum(), heat.mean()):
        assert isinstance(number, float)
    assert heat.max() == np.asarray(heat).max()


def test_a_spectrum_at_hand_serves_signatures(meshes):
    _, first, _ = meshes
    fresh = first.hks(k=39)
    first.spectrum(40)
    stages = []
    again = first.hks(k=39, progress=lambda stage, fraction: stages.append(stage))
    assert not stages
    np.testing.assert_allclose(again, fresh, rtol=1e-8)
    first.hks(k=40, progress=lambda stage, fraction: stages.append(stage))
    assert stages


@pytest.mark.parametrize("call, words", [
    (lambda a, b: tufted.functional_map(a, 3), "functional_map: target is a int, must be a PointCloud or a Mesh"),
    (lambda a, b: tufted.functional_map(a, tufted.Mesh(b.points, b.faces[:0])), "a shape has the area 0, must have"),
    (lambda a, b: tufted.functional_map(a, b, commutativity=-1), "commutativity = -1, must be finite and at least 0"),
    (lambda a, b: tufted.functional_map(a, b, weights=[1]), "weights is given, must be None without descriptors"),
    (lambda a, b: tufted.functional_map(a, b, a.M), "descriptors must be a pair"),
    (lambda a, b: tufted.functional_map(a, b, (a.M, b.points)), "descriptors have 1 and 3 columns"),
    (lambda a, b: tufted.functional_map(a, b, (a.M, np.full(len(b), np.nan))), "descriptors of the target have a value that is not"),
    (lambda a, b: tufted.functional_map(a, b, (a.M, b.M), weights=[-1]), "weights has -1, must be finite"),
    (lambda a, b: tufted.functional_map(a, b, landmarks=[[0, 10**6]]), "landmarks has 1000000, must lie in [0, 1326)"),
    (lambda a, b: tufted.functional_map(a, b, landmarks=[0, 1, 2]), "landmarks has the shape 3, must be P x 2"),
    (lambda a, b: tufted.zoom_out(a, b, np.eye(3)[:2]), "start has the shape 2 x 3, must be k x k"),
    (lambda a, b: tufted.zoom_out(a, b, [0, 1]), "start must be a matrix, or 1326 indices below 1326"),
    (lambda a, b: tufted.point_maps(a, b, np.full((3, 3), np.nan)), "C has a value that is not finite"),
    (lambda a, b: tufted.point_maps(a, b, np.zeros((0, 0))), "point_maps: C has the shape 0 x 0, must be k x k"),
    (lambda a, b: tufted.point_maps(a, b, np.eye(3)[0]), "point_maps: C has the shape 3, must be k x k"),
    (lambda a, b: tufted.point_maps(a, b, [[1, 2], [3]]), "point_maps: C is no array"),
    (lambda a, b: tufted.zoom_out(a, b, [[1, 2], [3]]), "zoom_out: start is no array"),
    (lambda a, b: tufted.zoom_out(a, b, -np.ones(len(b), int)), "zoom_out: start has no index of at least 0"),
    (lambda a, b: tufted.zoom_out(a, tufted.Mesh(b.points, b.faces[:0]), np.eye(3)), "zoom_out: a shape has the area"),
    (lambda a, b: tufted.point_maps(tufted.Mesh(b.points, b.faces[:0]), b, np.eye(3)), "point_maps: a shape has the"),
    (lambda a, b: tufted.functional_map(a, b, (0 * a.M, b.M)), "descriptors have no column that is not 0 and has a"),
    (lambda a, b: tufted.functional_map(a, b, (a.M, b.M), weights=[0]), "descriptors have no column that is not 0"),
    (lambda a, b: tufted.functional_map(a, tufted.Mesh(np.vstack([b.points, [[9] * 3]]), b.faces),
                                        landmarks=[[0, 1326]]), "landmarks has 1326, a point of the target that takes"),
])
def test_mistakes_are_named(meshes, call, words):
    with pytest.raises(tufted.InvalidInput) as caught:
        call(*meshes[1:])
    assert words in str(caught.value)


def main():
    """Prints the table of docs/python.md: means over the seeds 101 to 105 of the greater mean error of both ways."""
    print("| pair | functional map | refined | with landmarks | with landmarks, refined |\n|---|---|---|---|---|")
    uv, faces = triangle_mesh(50)
    report("triangle of 1,326 vertices, rolled up",
           [(tufted.Mesh(flat(uv), faces), tufted.Mesh(rolled(uv), faces), uv, uv)])
    for count in (2000, 8000):
        pairs = [(triangle_sample(count, seed), triangle_sample(count, seed + 100)) for seed in range(101, 106)]
        report(f"triangle, samples of {count:,} points", [(*clouds(flat(a), rolled(b)), a, b) for a, b in pairs])
    for count in (2000, 8000):
        pairs = [(body(count, seed), body(count, seed + 100)) for seed in range(101, 106)]
        report(f"body with a side pushed in, samples of {count:,} points",
               [(*clouds(a, pushed_in(b)), a, b) for a, b in pairs])


def clouds(*points):
    return [tufted.PointCloud(each, "clean") for each in points]


def report(name, pairs):
    found = []
    for first, second, a, b in pairs:
        places = np.linspace(0, len(a) - 1, 5).astype(int)
        landmarks = [(i, np.linalg.norm(b - a[i], axis=1).argmin()) for i in places]
        maps = [tufted.functional_map(first, second, landmarks=given) for given in ((), landmarks)]
        maps = [each for C in maps for each in (C, tufted.zoom_out(first, second, C))]
        found.append([max(errors(tufted.point_maps(first, second, C), a, b, first.M.sum())) for C in maps])
    print(f"| {name} | " + " | ".join(f"{100 * error:.1f} %" for error in np.mean(found, axis=0)) + " |", flush=True)


if __name__ == "__main__":
    main()
