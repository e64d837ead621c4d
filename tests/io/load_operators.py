"""Loads what `tufted operators` wrote, with the reader of DiffusionNet's cache in mind. 77 (skipped) without scipy."""
import subprocess
import sys

try:
    import numpy as np
    import scipy.sparse
    import scipy.sparse.linalg
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


def read_cache(path, verts, faces, k):
    """The tuple that DiffusionNet takes from its cache: it looks for the same vertices, faces and enough eigenvectors."""
    arrays = np.load(path, allow_pickle=True)
    assert np.array_equal(arrays["verts"], verts) and np.array_equal(arrays["faces"], faces)
    assert k <= arrays["k_eig"].item()
    return (arrays["frames"], arrays["mass"], matrix(arrays, "L"), arrays["evals"][:k], arrays["evecs"][:, :k],
            matrix(arrays, "gradX"), matrix(arrays, "gradY"))


# A layer of DiffusionNet on the sphere: heat spreads by the eigenvectors, and features are products of gradients. After
# a time t the height z is exp(-2 t) z, and the gradients of x, y, z have the products of e_i - n n_i.
cloud = operators("sphere_uniform.ply", 49)
frames, mass, L, evals, evecs, gradX, gradY = read_cache(f"{out}/operators.npz", cloud["verts"], cloud["faces"], 40)
verts, t = cloud["verts"], 0.3
heat = evecs @ (np.exp(-evals * t)[:, None] * (evecs.T @ (mass[:, None] * verts)))
assert np.abs(heat - np.exp(-2 * t) * verts).max() < 0.05
implicit = scipy.sparse.linalg.spsolve(scipy.sparse.diags(mass).tocsc() + t * L, mass * verts[:, 2])
assert np.abs(implicit - verts[:, 2] / (1 + 2 * t)).max() < 0.05
slopes = np.stack((gradX @ verts, gradY @ verts), axis=1)  # N x 2 x 3
products = np.einsum("nai,naj->nij", slopes, slopes)
normals = frames[:, 2]
assert np.abs(products - (np.eye(3) - normals[:, :, None] * normals[:, None, :])).max() < 1e-9
assert np.abs(np.abs(np.sum(normals * verts, axis=1)) - 1).max() < 0.02
# What --spectrum reads is what is found.
samples_file = f"{samples}/sphere_uniform.ply"
subprocess.run([command, "spectrum", samples_file, "--count", "48", "--out", f"{out}/pairs"], check=True,
               stdout=subprocess.DEVNULL)
subprocess.run([command, "operators", samples_file, "--spectrum", f"{out}/pairs", "--out", f"{out}/read"], check=True,
               stdout=subprocess.DEVNULL)
again = np.load(f"{out}/read/operators.npz")
assert again["k_eig"].item() == 49 and np.abs(again["evals"] - cloud["evals"]).max() < 1e-6
