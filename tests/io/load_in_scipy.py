"""Loads what write_sample wrote, as a user would. Exit code 77 (skipped) without scipy."""
import json
import os
import sys

try:
    import numpy as np
    import scipy.io
    import scipy.sparse
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

root = sys.argv[1]
NAMES = ["M", "status", "representative", "boundary"]


def path(*names):
    return os.path.join(root, *names)


def same_bits(a, b):
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def same_matrix(a, b):
    """Bit for bit, with the same entries stored."""
    a, b = scipy.sparse.csc_matrix(a), scipy.sparse.csc_matrix(b)
    for matrix in (a, b):
        matrix.sum_duplicates()
    return (a.shape == b.shape and np.array_equal(a.indptr, b.indptr) and np.array_equal(a.indices, b.indices)
            and same_bits(a.data, b.data))


def spmat(file):
    """As MATLAB's spconvert(load(file)): the largest indices are the size."""
    rows, columns, values = np.loadtxt(file, unpack=True, ndmin=2)
    return scipy.sparse.coo_matrix((values, (rows.astype(int) - 1, columns.astype(int) - 1)))


def petsc(file):
    """A matrix or a vector as PETSc's bin/PetscBinaryIO.py reads it."""
    with open(file, "rb") as stream:
        mark, rows = np.fromfile(stream, ">i4", 2)
        if mark == 1211214:
            return np.fromfile(stream, ">f8").astype(float)
        columns, entries = np.fromfile(stream, ">i4", 2)
        assert mark == 1211216
        indptr = np.concatenate([[0], np.cumsum(np.fromfile(stream, ">i4", rows))])
        indices, data = np.fromfile(stream, ">i4", entries), np.fromfile(stream, ">f8")
    return scipy.sparse.csr_matrix((data.astype(float), indices, indptr), (rows, columns))


def load(folder):
    """L and the values per point, from npz and npy; all other files must hold the same."""
    L = scipy.sparse.load_npz(path(folder, "L.npz"))
    assert L.format == "csc" and L.dtype == np.float64 and L.indices.dtype == np.int32, repr(L)
    assert L.has_canonical_format
    values = {name: np.load(path(folder, name + ".npy")) for name in NAMES}
    column = values["M"].reshape(-1, 1)
    frames = np.load(path(folder, "frames.npy"))
    assert frames.dtype == np.float64 and frames.shape in ((L.shape[0], 3, 3), (0, 3, 3))
    assert np.allclose((frames @ frames.transpose(0, 2, 1))[values["status"][:len(frames)] == 0], np.eye(3))

    assert same_matrix(scipy.io.mmread(path(folder, "L.mtx")), L)
    assert scipy.io.mminfo(path(folder, "L.mtx"))[3:] == ("coordinate", "real", "symmetric")
    assert same_bits(scipy.io.mmread(path(folder, "M.mtx")), column)

    mat = scipy.io.loadmat(path(folder, "laplacian.mat"))
    assert same_matrix(mat["L"], L)
    for name in NAMES:
        assert same_bits(mat[name], values[name].reshape(-1, 1)), (name, mat[name].dtype)

    triplets = spmat(path(folder, "L.spmat"))
    last = L.shape[0] - 1
    assert triplets.row[-1] == triplets.col[-1] == last
    if L[last, last] == 0:  # there for the size alone
        triplets.row, triplets.col, triplets.data = triplets.row[:-1], triplets.col[:-1], triplets.data[:-1]
    assert same_matrix(triplets, L)
    masses = spmat(path(folder, "M.spmat")).tocsc()
    assert masses.shape == L.shape and same_bits(masses.diagonal(), values["M"])

    assert same_matrix(petsc(path(folder, "L.petsc")), L)
    assert same_bits(petsc(path(folder, "M.petsc")), values["M"])

    with open(path(folder, "report.json")) as file:
        report = json.load(file)
    with open(path(folder, "L.mtx")) as file:
        comments = file.read().split("\n")[1:]
    lines = str(mat["conventions"][0]).split("\n")
    for name in ("L", "sign", "M", "poisson", "eigenproblem", "inactive"):
        line = name + ": " + report["conventions"][name]
        assert "% " + line in comments and line in lines, line
    return L, values, report


L, values, report = load("triangle")
expected = np.array([[1, -0.5, -0.5, 0], [-0.5, 0.5, 0, 0], [-0.5, 0, 0.5, 0], [0, 0, 0, 0]])
assert np.array_equal(L.toarray(), expected)
arrays = {
    "M": np.array([2 / 3, 2 / 3, 2 / 3, 0]),
    "status": np.array([0, 0, 0, 1], np.uint8),
    "representative": np.array([0, 1, 2, 3], np.int32),
    "boundary": np.array([1, 2, 3, 0], np.uint8),
}
for name, expected in arrays.items():
    assert same_bits(values[name], expected) and values[name].flags.c_contiguous, (name, values[name])
    # The values begin at a multiple of 64 bytes, so that a memory map is aligned.
    assert np.load(path("triangle", name + ".npy"), mmap_mode="r").offset % 64 == 0, name
assert report["report"]["not_finite"] == 1 and report["report"]["votes"] == [1, 2, 3]
assert "L x = lambda M x" in report["conventions"]["eigenproblem"]

# A real cloud with a point twice and a last one missing: the arrays of the library, bit for bit.
L, values, report = load("cloud")
assert list(values["status"][-2:]) == [2, 1] and values["representative"][-2] == 0
assert same_bits(L.indptr, np.fromfile(path("indptr"), np.int32))
assert same_bits(L.indices, np.fromfile(path("indices"), np.int32))
assert same_bits(L.data, np.fromfile(path("data"), np.float64))
assert same_bits(values["M"], np.fromfile(path("M"), np.float64))
assert np.all(L.diagonal()[:-2] > 0) and L[-2:].nnz == 0

# The same with --sign igl --dummy: negated, and of full rank.
changed, changed_values, report = load("changed")
assert same_matrix(changed[:-2, :-2], -L[:-2, :-2])
assert np.array_equal(changed[-2:].toarray(), -np.eye(L.shape[0])[-2:])
assert same_bits(changed_values["M"][:-2], values["M"][:-2])
assert np.all(changed_values["M"][-2:] > 0) and changed_values["M"][-1] < 0.01 * values["M"][:-2].min()
assert report["write_options"]["sign"] == "igl" and report["write_options"]["dummy"] is True
assert "negative semidefinite" in report["conventions"]["L"] and "dummy" in report["conventions"]["inactive"]
