"""Loads what `tufted operators` wrote, with the reader of DiffusionNet's cache in mind. 77 (skipped) without scipy."""
import subprocess
import sys

try:
    import numpy as np
    import scipy.sparse
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

command, samples, out = sys.argv[1:]


def operators(name, count):
    subprocess.run([command, "operators", f"{samples}/{name}", "--count", str(count), "--out", out], check=True,
                   stdout=subprocess.DEVNULL)
    arrays = np.load(f"{out}/operators.npz", allow_pickle=False)
    expected = {"verts", "faces", "frames", "k_eig", "mass", "evals", "evecs"}
    for prefix in ("L", "gradX", "gradY"):
        expected |= {f"{prefix}_{part}" for part in ("data", "indices", "indptr", "shape")}
    assert set(arrays.files) == expected, set(arrays.files) ^ expected
    return arrays


def matrix(arrays, prefix):
    parts = (arrays[prefix + "_data"], arrays[prefix + "_indices"], arrays[prefix + "_indptr"])
    return scipy.sparse.csc_matrix(parts, shape=arrays[prefix + "_shape"])


for name, is_cloud in (("sphere_uniform.ply", True), ("icosphere.ply", False)):
    arrays = operators(name, 9)
    verts, frames = arrays["verts"], arrays["frames"]
    n = len(verts)
    assert verts.shape == (n, 3) and frames.shape == (n, 3, 3) and arrays["k_eig"].item() == 9
    assert arrays["faces"].dtype == np.int64 and arrays["faces"].shape[1] == 3
    assert (len(arrays["faces"]) == 0) == is_cloud
    # Rows of a frame are its axes, right-handed, the last one the normal.
    assert np.allclose(np.cross(frames[:, 0], frames[:, 1]), frames[:, 2], atol=1e-12)
    assert np.all(np.abs(np.sum(frames[:, 2] * verts, axis=1)) > 0.95)
    L, mass, evecs = matrix(arrays, "L"), arrays["mass"], arrays["evecs"]
    assert evecs.shape == (n, 9) and arrays["evals"].shape == (9,)
    assert np.abs(L @ evecs - mass[:, None] * evecs * arrays["evals"]).max() < 1e-8
    assert np.abs(evecs.T @ (mass[:, None] * evecs) - np.eye(9)).max() < 1e-9
    # The gradient of z on the sphere, in space.
    z = verts[:, 2]
    slope = (matrix(arrays, "gradX") @ z)[:, None] * frames[:, 0] + (matrix(arrays, "gradY") @ z)[:, None] * frames[:, 1]
    exact = np.array([0, 0, 1]) - z[:, None] * verts
    assert np.linalg.norm(slope - exact) < 0.1 * np.linalg.norm(exact), name
