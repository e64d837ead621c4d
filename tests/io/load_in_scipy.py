"""Loads what write_sample wrote, as a user would. Exit code 77 (skipped) without scipy."""
import json
import os
import sys

try:
    import numpy as np
    import scipy.sparse
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

folder = sys.argv[1]


def path(name):
    return os.path.join(folder, name)


L = scipy.sparse.load_npz(path("L.npz"))
assert L.format == "csc" and L.dtype == np.float64 and L.indices.dtype == np.int32, repr(L)
assert L.has_canonical_format
expected = np.array([[1, -0.5, -0.5, 0], [-0.5, 0.5, 0, 0], [-0.5, 0, 0.5, 0], [0, 0, 0, 0]])
assert np.array_equal(L.toarray(), expected)

arrays = {
    "M": np.array([2 / 3, 2 / 3, 2 / 3, 0]),
    "status": np.array([0, 0, 0, 1], np.uint8),
    "representative": np.array([0, 1, 2, 3], np.int32),
    "boundary": np.array([1, 1, 1, 0], np.uint8),
}
for name, values in arrays.items():
    loaded = np.load(path(name + ".npy"))
    assert loaded.dtype == values.dtype and loaded.flags.c_contiguous, (name, loaded.dtype)
    assert np.array_equal(loaded, values), (name, loaded)
    # The values begin at a multiple of 64 bytes, so that a memory map is aligned.
    assert np.load(path(name + ".npy"), mmap_mode="r").offset % 64 == 0, name

with open(path("report.json")) as file:
    report = json.load(file)
assert report["report"]["not_finite"] == 1 and report["report"]["votes"] == [1, 2, 3]
assert "L x = lambda M x" in report["conventions"]["eigenproblem"]
