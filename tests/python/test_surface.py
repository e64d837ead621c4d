"""Methods of clouds and meshes against what is known of spheres and tori."""
import pickle
import xml.etree.ElementTree

import numpy as np
import pytest

import tufted
from support import CLOUD, same, sphere, torus_mesh


def test_the_spectrum_is_that_of_the_sphere(cloud):
    values, vectors = cloud.spectrum(9)
    np.testing.assert_allclose(values, [0, 2, 2, 2, 6, 6, 6, 6, 6], atol=1e-8, rtol=0.02)
    np.testing.assert_allclose(vectors.T @ (cloud.M[:, None] * vectors), np.eye(9), atol=1e-9)
    assert abs(cloud.L @ vectors - cloud.M[:, None] * vectors * values).max() < 1e-6
    np.testing.assert_array_equal(cloud.spectrum(8, null_space=False).values > 0, True)


def test_signatures_are_those_of_a_homogeneous_surface(cloud):
    pairs = cloud.spectrum(49)
    hks = cloud.hks([0.5], spectrum=pairs)
    l = np.arange(0, 7)
    assert hks.mean() == pytest.approx(sum((2 * l + 1) * np.exp(-l * (l + 1) * 0.5)) / (4 * np.pi), rel=0.02)
    assert cloud.hks(k=40).shape == (3000, 16) and cloud.wks(k=40).shape == (3000, 100)
    assert cloud.wks([0.7, 1.8], spectrum=pairs).shape == (3000, 2)
    assert cloud.embed(3).shape == (3000, 3)


def test_filter_keeps_what_is_smooth(cloud):
    z = CLOUD[:, 2]
    rough = z + 0.1 * np.random.default_rng(3).normal(size=3000)
    assert abs(cloud.filter(rough, k=8) - z).mean() < 0.02
    halved = cloud.filter(z, k=3, gain=lambda eigenvalue: 0.5)
    np.testing.assert_allclose(halved, z / 2, atol=0.05)
    with pytest.raises(ZeroDivisionError):
        cloud.filter(z, k=3, gain=lambda eigenvalue: 1 / 0)


def test_distances_are_those_of_the_sphere(cloud):
    exact = np.arccos(np.clip(CLOUD @ CLOUD[0], -1, 1))
    assert abs(cloud.distance(0) - exact).mean() < 0.005 * np.pi / 2
    adapted = cloud.distance([0], method="heat", unit="adapted", open_boundary=False)
    assert abs(adapted - exact).mean() < 0.02 * np.pi / 2


def test_paths_run_along_great_circles(cloud):
    points, length = cloud.path(0, 1500)
    exact = np.arccos(np.clip(CLOUD[0] @ CLOUD[1500], -1, 1))
    assert abs(length - exact) < 0.01 * exact
    np.testing.assert_array_equal(points[[0, -1]], CLOUD[[0, 1500]])
    assert abs(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() - length) < 0.002 * length
    with pytest.raises(tufted.InvalidInput, match="path: end has 2 indices, must be one"):
        cloud.path(0, [1, 2])


def test_traced_lines_run_along_great_circles(cloud):
    start, direction = CLOUD[0], np.cross(CLOUD[0], [1, 0, 0])
    direction /= np.linalg.norm(direction)
    line = cloud.trace(0, 3 * direction, 1.5)
    end = np.cos(1.5) * start + np.sin(1.5) * direction
    assert np.linalg.norm(line.points[-1] - end) < 0.5 * np.sqrt(4 * np.pi / 3000)
    assert np.linalg.norm(line.direction - (np.cos(1.5) * direction - np.sin(1.5) * start)) < 0.1
    assert line.length == 1.5 and line.ended_by == "length"
    np.testing.assert_allclose(line.barycentric @ cloud.positions[line.corners], line.points[-1], atol=1e-12)
    map = cloud.log_map(0)
    back = cloud.trace(0, map.coordinates[7] @ map.axes, np.linalg.norm(map.coordinates[7]))
    assert np.linalg.norm(back.points[-1] - CLOUD[7]) < 0.5 * np.sqrt(4 * np.pi / 3000)


def test_lines_start_inside_triangles_and_end_at_rims():
    square = tufted.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]], [[0, 1, 2], [0, 2, 3]])
    line = square.trace(0, [0, 1, 5], 9, barycentric=[0, 1, 1])
    np.testing.assert_array_equal(line.points, [[1, 0.5, 0], [1, 1, 0]])
    assert line.ended_by == "rim" and line.length == 0.5


def test_isolines_are_plane_sections(mesh):
    lines = mesh.isolines(mesh.points[:, 2], [-9, 0.1, 0.2])
    assert {line.value for line in lines} == {0.1, 0.2}
    for line in lines:
        assert line.closed
        np.testing.assert_allclose(line.points[:, 2], line.value, atol=1e-12)
        closed = np.vstack([line.points, line.points[:1]])
        assert line.length == pytest.approx(np.linalg.norm(np.diff(closed, axis=0), axis=1).sum(), rel=1e-12)
    assert mesh.isolines(np.full(len(mesh), np.nan), 0) == []


def test_the_nearest_source_is_the_one_that_the_distance_is_from(cloud):
    sources = [0, 150, 299]
    distance, source = cloud.nearest_source(sources)
    each = np.stack([cloud.distance(s) for s in sources])
    np.testing.assert_array_equal(distance, cloud.distance(sources))
    np.testing.assert_allclose(each[source, np.arange(len(cloud))], each.min(axis=0), atol=0.05)
    assert source.dtype == np.int32 and list(source[sources]) == [0, 1, 2]
    near = cloud.distance(0, maximum=0.5)
    np.testing.assert_array_equal(near, np.where(each[0] <= 0.5, each[0], np.inf))


def test_points_within_a_radius_are_those_of_the_distance(cloud):
    points, distances = cloud.points_within([0, 150], 0.5)
    whole = cloud.distance([0, 150])
    np.testing.assert_array_equal(points, np.flatnonzero(whole <= 0.5))
    np.testing.assert_array_equal(distances, whole[points])
    assert points.dtype == np.int32


def test_a_source_inside_a_triangle_lies_between_its_corners(mesh):
    corners = mesh.faces[7]
    distance = mesh.distance(faces=7, barycentric=[1, 1, 1])
    centre = mesh.points[corners].mean(axis=0)
    np.testing.assert_allclose(distance[corners], np.linalg.norm(mesh.points[corners] - centre, axis=1), atol=1e-12)
    np.testing.assert_array_equal(mesh.distance(faces=[7], barycentric=[[1, 0, 0]])[corners[0]], 0)


def test_interpolation_has_the_values_and_stays_within_them(cloud):
    u = cloud.harmonic({0: 1.0, 5: 3.0})
    assert u[0] == 1 and u[5] == 3 and u.min() >= 1 - 1e-11 and u.max() <= 3 + 1e-11
    np.testing.assert_array_equal(cloud.harmonic([0, 5], [1.0, 3.0]), u)
    assert cloud.harmonic([0, 5], [[1.0, 2], [3, 4]]).shape == (3000, 2)
    smooth = cloud.biharmonic({0: 1.0, 5: 3.0, 9: 2.0})
    np.testing.assert_allclose(smooth[[0, 5, 9]], [1, 3, 2])


def test_equations_are_solved(cloud):
    z = CLOUD[:, 2]
    u = cloud.poisson(2 * z)  # a spherical harmonic of eigenvalue 2
    assert abs(u - z).max() < 0.05
    np.testing.assert_array_equal(cloud.poisson(np.stack([2 * z, z], axis=1))[:, 0].shape, u.shape)
    pinned = cloud.poisson(np.zeros(3000), {0: 1.0, 5: 3.0})
    np.testing.assert_allclose(pinned, cloud.harmonic({0: 1.0, 5: 3.0}), atol=1e-9)
    green = cloud.green(0)
    cosine = CLOUD @ CLOUD[0]
    far = cosine < 0.9
    exact = -(np.log((1 - cosine[far]) / 2) + 1) / (4 * np.pi)
    assert green.shape == (3000,) and abs(green[far] - exact).max() < 0.02
    assert cloud.green([0, 5]).shape == (3000, 2)


def test_gradients_are_tangential_parts(cloud, mesh):
    for surface in (cloud, mesh):
        X, Y, frames = surface.gradients()
        z = surface.points[:, 2]
        expected = frames[:, :2, 2]
        found = np.stack([X @ z, Y @ z], axis=1)
        assert abs(found - expected).max() < (1e-9 if surface is cloud else 0.1)
    vectors = np.stack([cloud.gradients().X @ CLOUD[:, 2], cloud.gradients().Y @ CLOUD[:, 2]], axis=1)
    # Minus the Laplacian of z is 2 z, and the integral of 2 z^2 over the sphere 8 pi / 3.
    z = CLOUD[:, 2]
    assert -(cloud.M * z * cloud.divergence(vectors)).sum() == pytest.approx(8 * np.pi / 3, rel=0.02)
    u = np.random.default_rng(1).normal(size=3000)
    slopes = np.stack([cloud.gradients().X @ u, cloud.gradients().Y @ u], axis=1)
    left = (cloud.M * u * cloud.divergence(vectors)).sum()
    assert left == pytest.approx(-(cloud.M[:, None] * slopes * vectors).sum(), rel=1e-9)


def test_operators_have_the_names_of_diffusionnet(mesh):
    found = mesh.operators(16)
    assert set(found) == {"frames", "mass", "L", "evals", "evecs", "gradX", "gradY"}
    assert found["evecs"].shape == (len(mesh), 16)


def test_normals_point_outwards_and_curvature_is_one(cloud):
    assert (np.einsum("ij,ij->i", cloud.normals(), CLOUD) > 0.9).all()
    inward = cloud.normals(viewpoint=[0, 0, 0])
    assert (np.einsum("ij,ij->i", inward, CLOUD) < -0.9).all()
    found = cloud.curvature()
    np.testing.assert_allclose(found.mean, 1, atol=0.1)
    np.testing.assert_allclose(found.gaussian, 1, atol=0.2)
    assert found.directions.shape == (3000, 2, 3)
    assert cloud.curvature(method="laplacian").gaussian.size == 0


def test_normals_of_a_mesh_agree_also_where_its_faces_do_not(mesh):
    faces = mesh.faces.copy()
    faces[::3] = faces[::3, ::-1]
    mixed = tufted.Mesh(mesh.points, faces).normals()
    assert (np.sum(mixed * mesh.normals(), axis=1) > 0.9).all()


def test_curvature_of_a_mesh_has_the_sign_of_its_faces(mesh):
    outer = np.linalg.norm(mesh.points[:, :2], axis=1) > 1.39
    np.testing.assert_allclose(mesh.curvature().gaussian[outer], 1 / (0.4 * 1.4), rtol=0.1)


def test_triangles_close_the_sphere(cloud):
    faces = cloud.triangles()
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert counts.max() == 2 and (counts == 2).mean() > 0.99
    outward = np.einsum("ij,ij->i", np.cross(CLOUD[faces[:, 1]] - CLOUD[faces[:, 0]],
                                             CLOUD[faces[:, 2]] - CLOUD[faces[:, 0]]), CLOUD[faces[:, 0]])
    assert (outward > 0).mean() > 0.99


def test_segments_cover_the_sphere(cloud):
    labels, areas, seeds = cloud.segments(5)
    assert set(labels) == set(range(5)) and len(seeds) == 5
    assert areas.sum() == pytest.approx(cloud.M.sum())
    assert (np.diff(areas) <= 0).all()
    assert set(cloud.segments(seeds=[0, 1]).labels) == {0, 1}
    assert set(cloud.segments(3, method="spectral").labels) == {0, 1, 2}
    assert set(cloud.segments(method="parts").labels) == {0}
    with pytest.raises(tufted.InvalidInput, match="count = 3, must be none with method 'parts'"):
        cloud.segments(3, method="parts")


def test_denoise_brings_points_to_the_surface():
    random = np.random.default_rng(1)
    exact = random.normal(size=(3000, 3))
    exact /= np.linalg.norm(exact, axis=1)[:, None]
    noisy = exact + 0.02 * random.normal(size=exact.shape)
    found = tufted.denoise(noisy)
    off = lambda x: np.sqrt(np.mean((np.linalg.norm(x, axis=1) - 1) ** 2))
    assert off(found.points) < 0.4 * off(noisy)
    assert found.median_noise == pytest.approx(0.02, rel=0.2)
    assert found.moved == np.count_nonzero(found.noise) > 2900
    unmoved = tufted.denoise(exact)
    assert unmoved.moved == 0
    np.testing.assert_array_equal(unmoved.points, exact)


def test_denoise_moves_the_points_of_a_depth_image_along_their_rays():
    random = np.random.default_rng(1)
    u, v = np.meshgrid((np.arange(60) - 30) / 100, (np.arange(50) - 25) / 100)
    depth = 1 / (1 - 0.3 * u + 0.2 * v + 0.002 * random.normal(size=u.shape))
    origin = np.array([1, 2, 3])
    points = np.stack([u * depth, v * depth, depth], axis=-1).reshape(-1, 3) + origin
    found = tufted.denoise(points, image=(60, 50), viewpoint=origin)
    assert found.median_noise == pytest.approx(0.002, rel=0.1)
    np.testing.assert_allclose(np.cross(found.points - origin, points - origin), 0, atol=1e-14)
    cloud = tufted.PointCloud(points, image=(60, 50), viewpoint=origin)
    np.testing.assert_array_equal(found.points, cloud.positions)
    assert cloud.report["noise"] == found.median_noise


def test_smoothing_shrinks_and_keeps_fixed_points(cloud):
    fixed = np.zeros(3000, bool)
    fixed[:10] = True
    smooth = cloud.smooth(time_step=5, iterations=2, fixed=fixed)
    np.testing.assert_array_equal(smooth[:10], CLOUD[:10])
    assert np.linalg.norm(smooth[10:], axis=1).mean() < 1


def test_smoothing_by_taubin_and_with_the_volume(cloud):
    assert abs(np.linalg.norm(cloud.smooth(method="taubin", iterations=20), axis=1).mean() - 1) < 5e-3
    assert np.linalg.norm(cloud.smooth(time_step=20), axis=1).mean() < 0.95
    assert abs(np.linalg.norm(cloud.smooth(time_step=20, keep_volume=True), axis=1).mean() - 1) < 2e-3
    for method in ("implicit", "taubin"):
        np.testing.assert_array_equal(cloud.smooth_values(CLOUD, method=method), cloud.smooth(method=method))
    assert cloud.smooth_values(CLOUD[:, 0]).shape == (3000,)


def test_transport_of_a_tangent_vector(cloud):
    tangent = cloud.frames[0, 0]
    carried = cloud.transport(0, tangent)
    assert abs(np.einsum("ij,ij->i", carried, CLOUD)).max() < 0.2
    np.testing.assert_allclose(np.linalg.norm(carried, axis=1), 1, rtol=1e-6)


def test_nearest(cloud):
    assert cloud.nearest(CLOUD[17]) == 17
    np.testing.assert_array_equal(cloud.nearest(2 * CLOUD[:50]), np.arange(50))


def test_components_are_labelled_and_taken():
    points = np.vstack([sphere(300), 5 + 0.5 * sphere(800)])
    cloud = tufted.PointCloud(points)
    assert (cloud.components[300:] == 0).all() and (cloud.components[:300] == 1).all()
    largest = cloud.restricted_to()
    assert (largest.status[:300] == 3).all() and largest.M[:300].sum() == 0
    assert largest.spectrum(2, null_space=True).values[0] == 0
    assert np.isinf(cloud.distance(300)[:300]).all()
    assert same(cloud.restricted_to([0, 1]).L, cloud.L)


def test_the_checks_hold(cloud, mesh):
    for surface in (cloud, mesh):
        found = surface.validate()
        assert found["ok"] and found["faults"] == [] and found["masses_compared"]


def test_texts(cloud, mesh):
    assert repr(cloud) == f"<tufted.PointCloud: 3,000 points, 1 component, area {cloud.M.sum():.6g}>"
    assert "3,600 faces" in repr(mesh)
    for surface in (cloud, mesh):
        frame = xml.etree.ElementTree.fromstring(surface._repr_html_())
        assert frame.tag == "iframe" and "<canvas" in frame.get("srcdoc") and "component" in frame.get("srcdoc")
    assert len(cloud) == 3000


def test_structures_of_scans():
    u, v = np.meshgrid(np.linspace(-1, 1, 40), np.linspace(-1, 1, 30))
    image = np.stack([u, v, 3 + 0.1 * u * u], axis=-1).reshape(-1, 3)
    cloud = tufted.PointCloud(image, image=(40, 30), viewpoint=[0, 0, 0])
    assert cloud.report["active"] == 1200 and (cloud.frames[:, 2, 2] < 0).all()
    azimuth = np.linspace(-np.pi, np.pi, 200, endpoint=False)
    rings = [np.stack([5 * np.cos(azimuth), 5 * np.sin(azimuth), np.full(200, 0.4 * z)], axis=1) for z in range(8)]
    points, numbers = np.concatenate(rings), np.repeat(np.arange(8), 200)
    by_number = tufted.PointCloud(points, "lidar", rings=numbers)
    assert by_number.report["components"] == 1
    assert same(tufted.PointCloud(points, "lidar", rings="find").L, by_number.L)


def test_normals_of_an_open_sheet_point_up_where_up_is_given():
    x, y = np.random.default_rng(2).uniform(-1, 1, size=(2, 2000))
    valley = tufted.PointCloud(np.stack([x, y, 0.4 * x * x], axis=1), viewpoint=[0, 0, -9])
    assert (valley.normals()[:, 2] < 0).all() and (valley.normals(up=[0, 0, 2])[:, 2] > 0).all()
    with pytest.raises(tufted.InvalidInput, match="viewpoint and up"):
        valley.normals(up=[0, 0, 1], viewpoint=[0, 0, 1])


def test_welded_vertices_keep_their_indices_and_rows(mesh, tmp_path):
    points, faces = torus_mesh(60, 30)
    order = np.random.default_rng(1).permutation(faces.size)
    torn = np.empty((faces.size, 3))
    torn[order] = points[faces.ravel()]
    torn_faces = order.reshape(-1, 3)
    vertex = np.empty(faces.size, int)  # by torn vertex, that of the mesh
    vertex[order] = faces.ravel()
    path = tmp_path / "torn.obj"
    path.write_text("".join("v %r %r %r\n" % tuple(map(float, p)) for p in torn)
                    + "".join("f %d %d %d\n" % tuple(f + 1) for f in torn_faces))
    built = tufted.Mesh(torn, torn_faces, weld=True)
    for welded in (built, tufted.read(path, weld=True), pickle.loads(pickle.dumps(built))):
        assert len(welded.points) == len(welded.M) == faces.size and welded.report["components"] == 1
        a, b = np.flatnonzero(welded.status == 2)[[5, 2000]]
        for found, known in ((welded.distance(a), mesh.distance(vertex[a])),
                             (welded.distance(faces=[7], barycentric=[[0.2, 0.2, 0.6]]),
                              mesh.distance(faces=[7], barycentric=[[0.2, 0.2, 0.6]])),
                             (welded.harmonic([a, b], [1.0, 2]), mesh.harmonic(vertex[[a, b]], [1.0, 2])),
                             (welded.normals(), mesh.normals()), (welded.curvature().mean, mesh.curvature().mean)):
            np.testing.assert_allclose(found, known[vertex], atol=1e-8)
        assert welded.path(a, b).length == pytest.approx(mesh.path(vertex[a], vertex[b]).length, abs=1e-12)
    assert tufted.Mesh(torn, torn_faces).report["components"] == len(faces)


def test_trees_above_the_ground_are_a_warning(recwarn):
    random = np.random.default_rng(101)
    ground = np.column_stack([random.uniform(0, 40, (1600, 2)), random.normal(0, 0.1, 1600)])
    directions = random.normal(size=(400, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    crowns = 4 * directions * np.cbrt(random.random((400, 1))) + np.array([[10, 10, 9], [30, 30, 9]])[np.arange(400) % 2]
    for build in (tufted.PointCloud, tufted.denoise):
        with pytest.warns(tufted.TuftedWarning, match="as vegetation does above the ground"):
            build(np.vstack([ground, crowns]))
    recwarn.clear()
    tufted.PointCloud(ground)
    assert not recwarn.list


def test_sparse_depth_images_are_a_warning():
    points = np.array([((i % 80 - 40) / 50, (i // 80 - 30) / 50, 1) for i in range(4800)])
    points[np.random.default_rng(101).random(4800) < 0.7] = np.nan
    for build in (tufted.PointCloud, tufted.denoise):
        with pytest.warns(tufted.TuftedWarning, match="fewer than half of the pixels hold points"):
            build(points, image=(80, 60))
