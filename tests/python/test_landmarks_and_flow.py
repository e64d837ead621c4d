"""Distances of many landmarks at once, ways through points, and the conformalised mean curvature flow."""
import numpy as np
import pytest

import tufted
from support import CLOUD, sphere, torus_mesh


def test_distances_of_landmarks_are_those_of_single_queries(mesh):
    landmarks = [0, 900, 77, 0]
    for surface, options in ((mesh, {}), (mesh, {"method": "heat"}), (tufted.Mesh(*torus_mesh(), threads=1), {})):
        places = np.minimum(landmarks, len(surface) - 1)
        found = surface.distance_matrix(places, **options)
        for column, place in enumerate(places):
            np.testing.assert_array_equal(found[:, column], surface.distance(place, **options))
    stages = []
    with pytest.raises(tufted.Cancelled):
        mesh.distance_matrix(range(50), progress=lambda stage, fraction: stages.append(stage) or len(stages) < 3)
    assert len(stages) == 3
    with pytest.raises(tufted.InvalidInput, match="distance_matrix: sources has 1800"):
        mesh.distance_matrix([0, 1800])
    cloud = tufted.PointCloud(np.vstack([CLOUD, [[np.nan] * 3]]))
    assert np.isinf(cloud.distance_matrix([0, 3000])[:, 1]).all()
    with pytest.raises(tufted.InvalidInput, match="^distance_matrix: no source lies on a component"):
        cloud.distance_matrix([3000])
    inside = mesh.distance_matrix([5], faces=[7], barycentric=[[1, 1, 1]])
    np.testing.assert_array_equal(inside[:, 1], mesh.distance(faces=[7], barycentric=[[1, 1, 1]]))
    with pytest.raises(tufted.InvalidInput, match="^distance_matrix: source 1 lies inside a triangle"):
        mesh.distance_matrix([5], faces=[7], barycentric=[[1, 1, 1]], symmetric=True)


def test_ways_through_points_keep_their_class_on_clouds():
    """Around the hole of a torus of radii 1 and 0.4 a loop stays, and slides to the inside."""
    random = np.random.default_rng(101)
    u, v, share = random.uniform(size=(3, 12000)) * [[2 * np.pi], [2 * np.pi], [1.4]]
    u, v = u[share < 1 + 0.4 * np.cos(v)][:4000], v[share < 1 + 0.4 * np.cos(v)][:4000]
    ring = 1 + 0.4 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.4 * np.sin(v)], axis=1)
    cloud = tufted.PointCloud(np.vstack([points, points[:1]]))
    stops = cloud.nearest(np.stack([np.cos(np.arange(6)), np.sin(np.arange(6)), 0.4 + 0 * np.arange(6)], axis=1))
    loop = cloud.path_through(stops, closed=True)
    assert loop.length == pytest.approx(2 * np.pi * 0.6, rel=0.01)
    assert np.linalg.norm(loop.points[:, :2], axis=1).max() < 0.65
    np.testing.assert_array_equal(cloud.path_through([4000, stops[0]]).points, cloud.path_through([0, stops[0]]).points)
    with pytest.raises(tufted.InvalidInput, match="path_through: points has 1 indices"):
        cloud.path_through([5])
    far = tufted.PointCloud(np.vstack([points, [[50, 50, 50]]]))
    with pytest.raises(tufted.InvalidInput, match=r"path_through: points has 4000, must be corners of triangles\(\)"):
        far.path_through([0, 4000])


def test_ways_through_points_of_a_loaded_mesh_need_its_cover(mesh, tmp_path):
    mesh.save(tmp_path)
    with pytest.raises(tufted.InvalidInput, match="path_through: the cover is missing, must be saved: formats="):
        tufted.load(tmp_path).path_through([0, 900])


def test_the_conformal_mean_curvature_flow_makes_a_sphere():
    """Kazhdan et al. 2012: a closed surface without handles becomes round, and keeps its place and area."""
    points = CLOUD * [2, 1, 0.7] + 0.1 * CLOUD**2
    cloud = tufted.PointCloud(np.vstack([points, [[np.nan] * 3], points[:1]]))
    before = np.linalg.norm(points, axis=1)
    moved = cloud.mean_curvature_flow(steps=30, time_step=0.05)
    assert np.isnan(moved[3000]).all() and (moved[3001] == moved[0]).all()
    middle = cloud.M @ np.nan_to_num(cloud.points) / cloud.M.sum()
    radius = np.linalg.norm(moved[:3000] - middle, axis=1)
    assert before.std() / before.mean() > 0.25 and radius.std() / radius.mean() < 0.02
    assert 4 * np.pi * radius.mean()**2 == pytest.approx(cloud.M.sum(), rel=0.03)
    one, two = (cloud.mean_curvature_flow(steps=steps) for steps in (1, 2))
    assert np.nanmax(abs(one - two)) > 1e-3
    with pytest.raises(tufted.InvalidInput, match="mean_curvature_flow: time_step = 0, must lie in"):
        cloud.mean_curvature_flow(time_step=0)


def test_components_flow_on_their_own():
    """Whatever their sizes and distances are, each becomes round in its place; one without area stays."""
    egg = sphere(1500) * [2, 1, 1]
    flat = np.outer([0.0, 1, 2], [1, 0, 0])
    alone = tufted.PointCloud(egg).mean_curvature_flow(steps=20, time_step=0.05)
    both = tufted.PointCloud(np.vstack([egg, 1e-3 * egg + [30, 0, 0]])).mean_curvature_flow(steps=20, time_step=0.05)
    np.testing.assert_allclose(both[:1500], alone, atol=1e-6)
    np.testing.assert_allclose(both[1500:], 1e-3 * alone + [30, 0, 0], atol=1e-6)
    V, F = torus_mesh()
    mesh = tufted.Mesh(np.vstack([V, flat + 9]), np.vstack([F, [[800, 801, 802]]]))
    np.testing.assert_array_equal(mesh.mean_curvature_flow()[800:], flat + 9)
    np.testing.assert_allclose(mesh.mean_curvature_flow()[:800], tufted.Mesh(V, F).mean_curvature_flow(), atol=1e-9)


def test_the_flow_works_in_any_unit():
    V, F = torus_mesh()
    expected = tufted.Mesh(V, F).mean_curvature_flow(steps=3)
    for unit in (2.0**-400, 2.0**400):
        np.testing.assert_array_equal(tufted.Mesh(unit * V, F).mean_curvature_flow(steps=3), unit * expected)
    with pytest.raises(tufted.SolverFailure, match="mean_curvature_flow: .*time_step = 1e"):
        tufted.Mesh(V, F).mean_curvature_flow(time_step=1e100)
