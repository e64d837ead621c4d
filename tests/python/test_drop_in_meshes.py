"""Calls of potpourri3d's own tests and pages besides those of heat solvers, on shapes with known answers."""
import numpy as np
import pytest
import scipy.sparse

import tufted
import tufted as pp3d
from support import DATASETS, sphere, torus_mesh


def soup(count=999):
    """Random points, and random triangles that use all of them."""
    random = np.random.default_rng(777)
    return random.random((count, 3)), np.vstack([random.integers(0, count, (2 * count, 3)),
                                                 np.arange(count).reshape(-1, 3)])


def sphere_mesh(levels=4):
    """Vertices and faces of an octahedron of radius 1 that is refined."""
    V, F = np.vstack([np.eye(3), -np.eye(3)]), []
    for x in (0, 3):
        for y in (1, 4):
            for z in (2, 5):
                F.append((x, y, z) if (x + y + z) % 2 else (x, z, y))
    F = np.array(F)
    for _ in range(levels):
        E = pp3d.edges(V, F)
        middle = {tuple(pair): len(V) + k for k, pair in enumerate(E)}
        V = np.vstack([V, V[E[:, 0]] + V[E[:, 1]]])
        V /= np.linalg.norm(V, axis=1, keepdims=True)
        halves = [[middle[tuple(sorted((f[k], f[(k + 1) % 3])))] for k in range(3)] for f in F.tolist()]
        F = np.array([face for (a, b, c), (d, e, g) in zip(F.tolist(), halves)
                      for face in ((a, d, g), (d, b, e), (g, e, c), (d, e, g))])
    return V, F


@pytest.fixture(scope="module")
def ball():
    return sphere_mesh()


@pytest.mark.parametrize("ending", ["obj", "ply", "off"])
def test_meshes_and_clouds_are_written_and_read(ending, tmp_path):
    V, F = soup()
    path = tmp_path / f"mesh.{ending}"
    pp3d.write_mesh(V, F, path)
    again, faces = pp3d.read_mesh(str(path))
    np.testing.assert_array_equal(again, V)
    np.testing.assert_array_equal(faces, F)
    pp3d.write_point_cloud(V, str(path))
    np.testing.assert_array_equal(pp3d.read_point_cloud(path), V)


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    V, F = soup(9)
    path = tmp_path / "missing" / "mesh.off"
    for call in (lambda: pp3d.write_mesh(V, F, path), lambda: pp3d.write_point_cloud(V, str(path))):
        with pytest.raises(tufted.IoError, match="missing/mesh.off: cannot write: No such file"):
            call()


def test_texture_coordinates_are_written(tmp_path):
    V, F = soup(9)
    path = tmp_path / "test.obj"
    for kind, uv in (("per-vertex", V[:, :2]), ("per-face", F[:, :2] * 0.3), ("per-corner", np.zeros((F.size, 2)))):
        pp3d.write_mesh(V, F, path, UV_coords=uv, UV_type=kind)
        lines = path.read_text().splitlines()
        found = np.array([line.split()[1:] for line in lines if line.startswith("vt")], float)
        np.testing.assert_array_equal(found, uv)
        used = np.array([[corner.split("/") for corner in line.split()[1:]] for line in lines if line[0] == "f"], int)
        np.testing.assert_array_equal(used[..., 0], F + 1)
        expected = {"per-vertex": F, "per-face": np.arange(len(F))[:, None] + 0 * F,
                    "per-corner": np.arange(F.size).reshape(-1, 3)}[kind]
        np.testing.assert_array_equal(used[..., 1], expected + 1)
        np.testing.assert_array_equal(pp3d.read_mesh(path)[1], F)


def test_areas_and_the_cotan_laplacian(ball):
    V, F = ball
    face_area, vertex_area = pp3d.face_areas(V, F), pp3d.vertex_areas(V, F)
    assert face_area.shape == (len(F),) and vertex_area.sum() == pytest.approx(face_area.sum(), rel=1e-12)
    assert face_area.sum() == pytest.approx(4 * np.pi, rel=0.01)
    L = pp3d.cotan_laplacian(V, F, denom_eps=1e-10)
    assert scipy.sparse.isspmatrix_csr(L) and abs(L.sum()) < 1e-6
    ours = pp3d.mesh_laplacian(V, F, return_mass=False)  # the same where triangles are Delaunay
    np.testing.assert_allclose(L.toarray(), ours.toarray(), atol=1e-6)


@pytest.mark.parametrize("exponent", [-520, -266, 266, 500])
def test_areas_and_the_cotan_laplacian_in_any_unit(exponent):
    """Squares of areas would vanish or overflow; a power of two changes no digit."""
    V, F = torus_mesh(12, 8)
    scaled = np.ldexp(V, exponent)
    for areas in (pp3d.face_areas, pp3d.vertex_areas):
        np.testing.assert_array_equal(areas(scaled, F), np.ldexp(areas(V, F), 2 * exponent))
    assert (pp3d.cotan_laplacian(scaled, F) != pp3d.cotan_laplacian(V, F)).nnz == 0


def test_edges_are_those_of_the_faces(ball):
    V, F = ball
    E = pp3d.edges(V, F)
    assert len(V) - len(E) + len(F) == 2 and (E[:, 0] < E[:, 1]).all()
    np.testing.assert_array_equal(pp3d.edges(np.zeros((5, 3)), [[0, 1, 2, 3], [3, 2, 4]]),
                                  [[0, 1], [0, 3], [1, 2], [2, 3], [2, 4], [3, 4]])
    assert pp3d.edges(V, F).dtype == np.int32
    np.testing.assert_array_equal(pp3d.edges(V, F.tolist()), E)
    assert pp3d.edges(np.zeros((0, 3)), []).shape == pp3d.edges(V, F[:0]).shape == (0, 2)


def test_marching_triangles_gives_places_on_edges(ball):
    V, F = ball
    E, u = pp3d.edges(V, F), V @ [0.6, 0, 0.8]
    for curves in (pp3d.marching_triangles(V, F, u, 0.3),
                   pp3d.MeshMarchingTrianglesSolver(V, F).marching_triangles(u, isoval=0.3)):
        assert len(curves) == 1 and curves[0][0] == curves[0][-1]
        index, t = (np.array(part) for part in zip(*((e, t) for e, (t,) in curves[0])))
        values = (1 - t) * u[E[index, 0]] + t * u[E[index, 1]]
        np.testing.assert_allclose(values, 0.3, atol=1e-12)
        for k in range(len(index) - 1):  # neighbours lie in one triangle
            assert len(np.unique(E[index[k:k + 2]])) == 3
    assert pp3d.marching_triangles(V, F, u, 5.0) == []


def test_lines_end_where_values_are_not_finite(ball):
    V, F = ball
    u = V[:, 2].copy()
    u[V[:, 0] > 0.5], u[V[:, 0] < -0.5] = np.nan, np.inf
    E = pp3d.edges(V, F)
    curves = pp3d.marching_triangles(V, F, u, 0.3)
    assert len(curves) == 2 and all(curve[0] != curve[-1] for curve in curves)
    for index, (t,) in sum(curves, []):
        assert (1 - t) * u[E[index, 0]] + t * u[E[index, 1]] == pytest.approx(0.3, abs=1e-12)
    with pytest.raises(tufted.InvalidInput, match="marching_triangles: isoval = None, must be a number"):
        pp3d.marching_triangles(V, F, u, None)


def equator(V):
    """The vertices of a sphere on z = 0, by their angle."""
    on = np.flatnonzero(abs(V[:, 2]) < 1e-12)
    return on[np.argsort(np.arctan2(V[on, 1], V[on, 0]))]


def test_distances_from_curves(ball):
    V, F = ball
    ring = equator(V)
    latitude = np.arcsin(V[:, 2])
    curve = [(int(vertex), []) for vertex in [*ring, ring[0]]]
    marching = pp3d.MeshFastMarchingDistanceSolver(V, F)
    np.testing.assert_allclose(marching.compute_distance([curve]), abs(latitude), atol=0.01)
    np.testing.assert_allclose(marching.compute_distance([curve], sign=True), latitude, atol=0.01)
    heat = pp3d.MeshSignedHeatSolver(V, F)
    away = abs(latitude) < 1.4  # at the poles, where fronts meet, heat rounds the distance off
    np.testing.assert_allclose(heat.compute_distance([curve])[away], latitude[away], atol=0.03)
    np.testing.assert_allclose(heat.compute_distance([curve], [False]), abs(latitude), atol=0.01)
    pole = int(V[:, 2].argmax())
    several = heat.compute_distance([curve], [], [pole], level_set_constraint="ZeroSet")
    assert several[pole] == 0
    np.testing.assert_array_equal(heat.compute_distance([curve], points=[(pole, [])]), several)
    corner = heat.compute_distance([], points=[(0, [1.0, 0.0, 0.0])])
    np.testing.assert_array_equal(corner, heat.compute_distance([], points=[F[0, 0]]))
    expected = np.where(latitude > np.pi / 4, np.pi / 2 - latitude, latitude)
    np.testing.assert_allclose(several[latitude > -1.4], expected[latitude > -1.4], atol=0.03)


def test_distances_from_a_curve_through_faces_and_edges(ball):
    """A line of one height, as marching_triangles() returns it, whose segments cross faces."""
    V, F = ball
    latitude = np.arcsin(V[:, 2]) - np.arcsin(0.3)
    curve = pp3d.marching_triangles(V, F, V[:, 2], 0.3)[0]
    marching = pp3d.MeshFastMarchingDistanceSolver(V, F)
    np.testing.assert_allclose(marching.compute_distance([curve]), abs(latitude), atol=0.01)
    signed = pp3d.MeshSignedHeatSolver(V, F).compute_distance([curve])
    side = np.sign(signed[V[:, 2].argmax()])
    away = abs(V[:, 2]) < 0.98  # at the poles, where fronts meet, heat rounds the distance off
    np.testing.assert_allclose(side * signed[away], latitude[away], atol=0.03)
    np.testing.assert_allclose(side * marching.compute_distance([curve], sign=True), latitude, atol=0.01)
    middle = [(0, [1 / 3, 1 / 3]), (0, [1 / 3, 1 / 3, 1 / 3])]
    center = V[F[0]].mean(axis=0)
    np.testing.assert_allclose(marching.compute_distance([middle[:1]]),
                               np.arccos(np.clip(V @ center / np.linalg.norm(center), -1, 1)), rtol=0.015)
    np.testing.assert_allclose(*(marching.compute_distance([[place]]) for place in middle), rtol=1e-12)


def test_all_strategies_and_the_connection_laplacian(ball):
    V, F = ball
    for use_intrinsic_delaunay in (False, True):
        solver = pp3d.MeshVectorHeatSolver(V, F, use_intrinsic_delaunay=use_intrinsic_delaunay)
        assert solver.extend_scalar([1, 22], [0.0, 6.0]).min() >= 0
        for strategy in ("VectorHeat", "AffineLocal", "AffineAdaptive"):
            np.testing.assert_array_equal(solver.compute_log_map(1, strategy=strategy), solver.compute_log_map(1))
    connection = solver.get_connection_laplacian()
    assert isinstance(connection, scipy.sparse.csc_matrix) and abs(connection.diagonal().imag).max() == 0
    assert abs(connection - connection.getH()).max() < 1e-12
    # The smallest eigenvalue of the connection Laplacian of a sphere of radius 1 is 1 (Knoeppel et al. 2013).
    M = scipy.sparse.diags(pp3d.vertex_areas(V, F)).tocsc()
    values = scipy.sparse.linalg.eigsh(connection, 3, M, sigma=-0.01, return_eigenvectors=False)
    np.testing.assert_allclose(values, 1, rtol=0.03)


def test_a_flat_connection_has_constant_fields():
    """On a flat sheet a constant field is parallel, whatever the frames of the vertices are."""
    x, y = np.meshgrid(np.arange(6.0), np.arange(5.0), indexing="ij")
    V = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = np.arange(30).reshape(6, 5)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]))
    solver = pp3d.MeshVectorHeatSolver(V, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))
    basisX, basisY, _ = solver.get_tangent_frames()
    field = basisX[:, 0] + 1j * basisY[:, 0]  # the x axis in all frames
    assert abs(solver.get_connection_laplacian() @ field).max() < 1e-12


def test_polygons_are_cut_into_triangles(tmp_path):
    V, F = pp3d.read_polygon_mesh(DATASETS / "cube_quads.obj")
    assert isinstance(F, list) and all(len(face) == 3 for face in F)
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0.0]])
    solver = pp3d.PolygonMeshHeatSolver(square, [[0, 1, 2, 3], [1, 4, 5, 2]])
    assert solver.surface.M.sum() == pytest.approx(2)
    assert solver.compute_distance([0, 3])[[0, 3]].max() == 0
    assert solver.extend_scalar([0, 5], [0.0, 1.0]).shape == (6,)
    assert solver.transport_tangent_vectors([0], [[6.0, 6.0]]).shape == (6, 2)
    np.testing.assert_allclose(solver.compute_signed_distance([[1, 2]]), 1 - square[:, 0], atol=1e-6)
    assert len(solver.get_tangent_frames()) == 3


def test_paths_and_traces(ball):
    V, F = ball
    start, end = 0, int(V[:, 2].argmax())
    solver = pp3d.EdgeFlipGeodesicSolver(V, F)
    path = solver.find_geodesic_path(v_start=start, v_end=end, max_iterations=100, max_relative_length_decrease=0.5)
    np.testing.assert_array_equal(path[[0, -1]], V[[start, end]])
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() == pytest.approx(np.pi / 2, abs=0.01)
    V, F = torus_mesh(60, 30)  # vertex 30 i + j at i parts of a circle around the hole and j around the tube
    solver = pp3d.EdgeFlipGeodesicSolver(V, F)
    inside = [30 * i + 15 for i in (0, 20, 40, 50)]
    path = solver.find_geodesic_path_poly(inside, max_iterations=100, max_relative_length_decrease=0.5)
    np.testing.assert_array_equal(path[[0, -1]], V[[inside[0], inside[-1]]])
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() == pytest.approx(2 * np.pi * 0.6 * 50 / 60, rel=1e-3)
    loop = solver.find_geodesic_loop([3, 607, 1211])
    assert np.linalg.norm(loop - np.roll(loop, 1, axis=0), axis=1).sum() == pytest.approx(2 * np.pi * 0.6, rel=1e-3)
    assert solver.find_geodesic_loop([3, 97, 185], max_relative_length_decrease=0.5).shape == (1, 3)  # contracts
    V, F = ball
    tracer = pp3d.GeodesicTracer(V, F)
    for trace in (tracer.trace_geodesic_from_vertex(start, np.array((9.0, 0, 1))),  # from (1, 0, 0) along z
                  tracer.trace_geodesic_from_vertex(start, (0, 0, 1), max_iterations=10**6)):
        np.testing.assert_allclose(trace[-1], [np.cos(1), 0, np.sin(1)], atol=0.02)
    assert len(tracer.trace_geodesic_from_vertex(start, (0, 0, 1), max_iterations=3)) == 4
    inside = tracer.trace_geodesic_from_face(31, np.array((0.1, 0.4, 0.5)), np.array((0.3, 0.5, 0.4)))
    np.testing.assert_allclose(inside[0], (0.1, 0.4, 0.5) @ V[F[31]], atol=1e-12)


def test_signed_distances_on_a_cloud_follow_the_normals_given():
    P = sphere(3000)
    solver = pp3d.PointCloudHeatSolver(P)
    near = np.flatnonzero(abs(P[:, 2]) < 0.03)
    ring = near[np.argsort(np.arctan2(P[near, 1], P[near, 0]))]
    ring = [*ring, ring[0]]
    outside = solver.compute_signed_distance([ring], P)
    np.testing.assert_allclose(outside, np.arcsin(P[:, 2]), atol=0.12)
    np.testing.assert_allclose(solver.compute_signed_distance([ring], -P), -outside, atol=1e-9)


def test_the_local_triangulation_of_a_cartwheel():
    """A point amid thirty others on a circle has all thirty triangles, and each of the others two of them."""
    t = np.linspace(0, 2 * np.pi, 30, endpoint=False)
    points = np.vstack([np.zeros((1, 3)), np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)])
    found = pp3d.PointCloudLocalTriangulation(points).get_local_triangulation()
    normal = pp3d.PointCloud(points).frames[:, 2, 2]
    wheel = [(0, 1 + k, 1 + (k + 1) % 30) for k in range(30)]
    expected = {row if normal[0] > 0 else (row[0], row[2], row[1]) for row in wheel}
    assert {tuple(row) for row in found[0].tolist()} == expected
    for point in range(1, 31):
        rows = [row for row in found[point].tolist() if row[0] >= 0]
        assert all(row[0] == point and 0 in row for row in rows) and len(rows) == 2
        assert (found[point, 2:] == -1).all()


def marched(V, F, *curves):
    return pp3d.MeshFastMarchingDistanceSolver(V, F).compute_distance(*curves)


@pytest.mark.parametrize("call, words", [
    (lambda V, F: pp3d.write_mesh(V, F, "mesh.txt"), "filename = 'mesh.txt', must end in .obj, .ply or .off"),
    (lambda V, F: pp3d.write_mesh(V, F, "m.ply", V[:, :2], "per-vertex"), "must end in .obj to hold UV_coords"),
    (lambda V, F: pp3d.write_mesh(V, F, "m.obj", V[:, :2], "vertex"), "UV_type = 'vertex', must be None"),
    (lambda V, F: pp3d.write_mesh(V, F, "m.obj", V[:4, :2], "per-vertex"), "UV_coords has the shape 4 x 2"),
    (lambda V, F: pp3d.face_areas(V, F + len(V)), "face_areas: F has"),
    (lambda V, F: pp3d.edges(V, [[0, 10**6]]), "edges: F has 1000000"),
    (lambda V, F: marched(V, F, [[(0, [])]], [[1.0]]), "must be 0 or empty"),
    (lambda V, F: marched(V, F, [[(10**6, [])]]), "curves has 1000000"),
    (lambda V, F: marched(V, F, [[(0, [0.9, 0.9])]]), "must be one to three in [0, 1]"),
    (lambda V, F: marched(V, F, [[(0, [0.2] * 4)]]), "must be one to three in [0, 1]"),
    (lambda V, F: marched(np.vstack([V, V[:1]]), F, [[(96, [])]]), "curves has the vertex 96, must be a corner of a"),
    (lambda V, F: pp3d.MeshSignedHeatSolver(V, F).compute_distance([[(0, [])]], level_set_constraint="None"),
     "level_set_constraint = 'None', must be 'ZeroSet'"),
    (lambda V, F: pp3d.MeshSignedHeatSolver(V, F).compute_distance([]), "must have at least one source"),
    (lambda V, F: pp3d.MeshSignedHeatSolver(V, F, 0), "MeshSignedHeatSolver: t_coef = 0, must be finite and above 0"),
    (lambda V, F: pp3d.MeshSignedHeatSolver(V, F).compute_distance([], points=[99]), "points has 99, must lie in"),
    (lambda V, F: pp3d.MeshSignedHeatSolver(V, F).compute_distance([[]]), "compute_distance: curves is empty"),
    (lambda V, F: marched(V, F, []), "curves has no place, must have at least one"),
    (lambda V, F: marched(V, F, [[3, 4]]), "curves has the place 3, must be a tuple as (index, [])"),
    (lambda V, F: pp3d.write_mesh(V, F, "m.obj", V[:, :2]), "write_mesh: UV_coords is given, must be None without"),
    (lambda V, F: pp3d.MeshVectorHeatSolver(V, F).compute_log_map([0, 1]), "compute_log_map: v_ind has 2 indices"),
    (lambda V, F: pp3d.MeshVectorHeatSolver(V, F).compute_log_map(0, "Fast"), "strategy = 'Fast', must be one of"),
    (lambda V, F: pp3d.EdgeFlipGeodesicSolver(V, F).find_geodesic_loop([0]), "find_geodesic_loop: v_list has 1"),
    (lambda V, F: pp3d.EdgeFlipGeodesicSolver(V, F).find_geodesic_path(0, 10**6), "find_geodesic_path: v_end has"),
    (lambda V, F: pp3d.GeodesicTracer(V, F).trace_geodesic_from_vertex(0, [1, 2]), "direction_xyz has the shape 2"),
])
def test_mistakes_are_named_as_the_caller_names_them(call, words):
    with pytest.raises(tufted.InvalidInput) as caught:
        call(*torus_mesh(12, 8))
    assert words in str(caught.value)
