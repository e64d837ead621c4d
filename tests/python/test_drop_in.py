"""Scripts in the manner of robust_laplacian's and potpourri3d's pages, with the import changed."""
import numpy as np
import pytest
import scipy.sparse
import scipy.sparse.linalg

import tufted
import tufted as pp3d
import tufted as robust_laplacian
from support import DATASETS, sphere, torus_mesh


def test_eigenvectors_of_a_cloud_by_scipy():
    points = sphere(4000)
    L, M = robust_laplacian.point_cloud_laplacian(points)
    evals, evecs = scipy.sparse.linalg.eigsh(L, 10, M, sigma=1e-8)
    np.testing.assert_allclose(evals[1:4], 2, rtol=0.02)
    np.testing.assert_allclose(evals[4:9], 6, rtol=0.02)
    assert evecs.shape == (4000, 10)


def test_mesh_laplacian_has_the_area_and_scales():
    verts, faces = torus_mesh()
    L, M = robust_laplacian.mesh_laplacian(verts, faces)
    assert M.diagonal().sum() == pytest.approx(4 * np.pi**2 * 0.4, rel=0.02)
    assert abs(L @ np.ones(len(verts))).max() < 1e-12
    L2, M2 = robust_laplacian.mesh_laplacian(verts, faces, mollify_factor=1e-5)
    assert (L != L2).nnz == 0 and (M != M2).nnz == 0


def test_types_are_those_of_scipy():
    L, M = robust_laplacian.point_cloud_laplacian(sphere(200), mollify_factor=1e-4, n_neighbors=20)
    assert scipy.sparse.isspmatrix_csc(L) and scipy.sparse.issparse(M)
    assert L.shape == M.shape == (200, 200)
    L.data[0] += 1  # the caller's own
    assert scipy.sparse.isspmatrix_csc(robust_laplacian.point_cloud_laplacian(sphere(200), return_mass=False))


def test_points_that_take_no_part_do_not_make_the_matrices_singular():
    points = np.vstack([sphere(500), np.full((3, 3), np.nan), sphere(500)[:2]])
    L, M = robust_laplacian.point_cloud_laplacian(points)
    assert (L.diagonal() > 0).all() and (M.diagonal() > 0).all()
    evals = scipy.sparse.linalg.eigsh(L, 5, M, sigma=1e-8, return_eigenvectors=False)
    assert np.isfinite(evals).all()
    bare, masses = robust_laplacian.point_cloud_laplacian(points, dummy=False)
    assert (bare.diagonal() == 0).sum() == (masses.diagonal() == 0).sum() == 5


def test_distances_on_a_mesh():
    V, F = pp3d.read_mesh(str(DATASETS / "prism_good.off"))
    solver = pp3d.MeshHeatMethodDistanceSolver(V, F)
    dist = solver.compute_distance(7)
    several = solver.compute_distance_multisource([1, 2, 3])
    assert dist.shape == several.shape == (len(V),)
    assert dist[7] == 0 and (several[[1, 2, 3]] == 0).all()
    np.testing.assert_array_equal(pp3d.compute_distance(V, F, 7), dist)
    np.testing.assert_array_equal(pp3d.compute_distance_multisource(V, F, [1, 2, 3]), several)


def test_distances_on_a_cloud():
    P = sphere(3000)
    solver = pp3d.PointCloudHeatSolver(P)
    exact = np.arccos(np.clip(P @ P[4], -1, 1))
    np.testing.assert_allclose(solver.compute_distance(4), exact, atol=0.08)
    nearest = np.minimum(exact, np.arccos(np.clip(P @ P[9], -1, 1)))
    np.testing.assert_allclose(solver.compute_distance_multisource([4, 9]), nearest, atol=0.08)


def test_values_extend_from_the_nearest_source():
    P = sphere(3000)
    solver = pp3d.PointCloudHeatSolver(P, t_coef=1.0)
    values = solver.extend_scalar([0, 1], [0.0, 1.0])
    side = np.linalg.norm(P - P[1], axis=1) - np.linalg.norm(P - P[0], axis=1)
    assert values[side > 0.4].max() < 0.2 and values[side < -0.4].min() > 0.8


@pytest.mark.parametrize("make", [lambda: pp3d.PointCloudHeatSolver(sphere(2000)),
                                  lambda: pp3d.MeshVectorHeatSolver(*torus_mesh())])
def test_vectors_keep_their_length_and_start_as_given(make):
    solver = make()
    basisX, basisY, basisN = solver.get_tangent_frames()
    np.testing.assert_allclose(np.cross(basisN, basisX), basisY, atol=1e-12)
    carried = solver.transport_tangent_vector(5, [3.0, 4.0])
    assert carried.shape == (len(basisX), 2)
    np.testing.assert_allclose(np.linalg.norm(carried, axis=1), 5, rtol=1e-6)
    np.testing.assert_allclose(carried[5], [3, 4], atol=0.2)
    assert solver.transport_tangent_vectors([5, 9], [[1, 0], [0, 1]]).shape == carried.shape


@pytest.mark.parametrize("make", [lambda: pp3d.PointCloudHeatSolver(sphere(3000)),
                                  lambda: pp3d.MeshVectorHeatSolver(*torus_mesh(80, 40))])
def test_the_log_map_is_linear_next_to_its_point(make):
    solver = make()
    basisX, basisY, _ = solver.get_tangent_frames()
    logmap = solver.compute_log_map(10)
    P = solver.surface.points
    near = np.linalg.norm(P - P[10], axis=1) < 0.3
    plane = np.stack([(P - P[10]) @ basisX[10], (P - P[10]) @ basisY[10]], axis=1)
    np.testing.assert_allclose(logmap[near], plane[near], atol=0.06)


def test_steps_scale_with_t_coef():
    P = sphere(800)
    a, b = (pp3d.PointCloudHeatSolver(P, t_coef=t).compute_distance(0) for t in (1.0, 4.0))
    assert not np.array_equal(a, b)
    np.testing.assert_array_equal(a, tufted.PointCloud(P).distance(0, method="heat"))


@pytest.mark.parametrize("call, words", [
    (lambda: robust_laplacian.point_cloud_laplacian(sphere(50), n_neighbors=2),
     "point_cloud_laplacian: n_neighbors = 2, must be at least 3"),
    (lambda: robust_laplacian.point_cloud_laplacian(sphere(50), mollify_factor=-1),
     "point_cloud_laplacian: mollify_factor = -1, must lie in [0, 1]"),
    (lambda: robust_laplacian.mesh_laplacian(sphere(9), [[0, 1, 9]]), "mesh_laplacian: triangle 0 names vertex 9"),
    (lambda: robust_laplacian.mesh_laplacian(np.zeros((9, 2)), [[0, 1, 2]]),
     "mesh_laplacian: verts has the shape 9 x 2"),
    (lambda: pp3d.PointCloudHeatSolver(sphere(50), t_coef=0), "t_coef = 0, must be finite and above 0"),
    (lambda: pp3d.PointCloudHeatSolver(sphere(50)).compute_distance(50), "has 50, must lie in [0, 50)"),
])
def test_mistakes_are_named_as_the_caller_names_them(call, words):
    with pytest.raises(ValueError) as caught:
        call()
    assert isinstance(caught.value, tufted.InvalidInput)
    assert words in str(caught.value)
