"""Clouds that are larger than memory."""
import json

import numpy as np
import pytest
import scipy.sparse

import tufted
from support import sphere


def loaded(out):
    return (scipy.sparse.csr_matrix(tuple(np.load(out / f"L_{part}.npy", mmap_mode="r")
                                          for part in ("data", "indices", "indptr"))), np.load(out / "M.npy"))


def test_tiles_of_a_file_and_of_points_have_the_matrices_of_the_whole(tmp_path):
    points = sphere(2000)
    np.save(tmp_path / "points.npy", points)
    whole = tufted.PointCloud(points, "clean")
    for source in (tmp_path / "points.npy", points):
        report = tufted.laplacian_by_tiles(source, tmp_path / "out")
        assert report["active"] == 2000
        L, M = loaded(tmp_path / "out")
        assert abs(L - whole.L).max() < 1e-12 * whole.L.diagonal().max()
        np.testing.assert_allclose(M, whole.M, rtol=1e-12)


def test_tiles_of_a_part_have_its_rows(tmp_path):
    points = sphere(2000)
    np.save(tmp_path / "points.npy", points)
    report = tufted.laplacian_by_tiles(tmp_path / "points.npy", tmp_path / "out", where="z=0..2")
    np.testing.assert_array_equal(np.load(tmp_path / "out" / "file_row.npy"), np.flatnonzero(points[:, 2] >= 0))
    assert report["points"] == (points[:, 2] >= 0).sum()
    with open(tmp_path / "out" / "report.json", encoding="utf-8") as file:
        assert json.load(file)["selection"] == {"where": ["z=0..2"]}


def test_mistakes_are_named(tmp_path):
    def refused(match, error=tufted.InvalidInput, source=sphere(100), **options):
        with pytest.raises(error, match="^laplacian_by_tiles: " + match if error is tufted.InvalidInput else match):
            tufted.laplacian_by_tiles(source, tmp_path / "out", **options)
        assert not (tmp_path / "out" / "report.json").exists()
    refused("preset = 'scan', must be 'clean' unless keep_noise is True", preset="scan")
    refused("preset = 'none', must be one of", preset="none")
    refused("memory = 1000 bytes, must be more than", memory=1000)
    refused("where, crop, polygon or thin is given, must not be for points", thin=1)
    refused("nowhere.ply", tufted.IoError, source="nowhere.ply")
    with pytest.warns(tufted.TuftedWarning, match="no point is active"):
        tufted.laplacian_by_tiles(np.full((5, 3), np.nan), tmp_path / "none")


def test_noise_is_kept_if_asked(tmp_path):
    points = sphere(1000) * (1 + 1e-3 * np.random.default_rng(3).normal(size=(1000, 1)))
    report = tufted.laplacian_by_tiles(points, tmp_path / "out", preset="scan", keep_noise=True)
    assert report["active"] == 1000
