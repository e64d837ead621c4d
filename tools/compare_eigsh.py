#!/usr/bin/env python3
"""Times 64 eigenpairs by `tufted spectrum` and by scipy's eigsh, on the same matrices, on one thread, one after the other.

    tools/compare_eigsh.py build/release/tufted [--points 100000] [--pairs 64]

Needs python3-scipy. Prints the seconds of both, their ratio, and how far the eigenvalues are apart; ends with 1 if ours
takes more than half as long, or they differ by more than a part in 10^8.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"  # before numpy starts its threads
import numpy as np
import scipy.sparse
from scipy.sparse.linalg import eigsh


def sphere(points):
    """Random points on the unit sphere, evenly distributed."""
    rows = np.random.default_rng(1).normal(size=(points, 3))
    return rows / np.linalg.norm(rows, axis=1)[:, None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tufted")
    parser.add_argument("--points", type=int, default=100000)
    parser.add_argument("--pairs", type=int, default=64)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cloud, operator, out = (os.path.join(folder, name) for name in ("sphere.xyz", "operator", "out"))
        np.savetxt(cloud, sphere(arguments.points))
        run = lambda *words: subprocess.run([arguments.tufted, *words, "--threads", "1"], check=True,
                                            stdout=subprocess.DEVNULL)
        run("laplacian", cloud, "--out", operator, "--format", "npz")
        run("spectrum", "--operator", operator, "--count", str(arguments.pairs), "--out", out)
        with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
            report = json.load(file)["report"]
        ours = np.load(os.path.join(out, "evals.npy"))
        L = scipy.sparse.load_npz(os.path.join(operator, "L.npz"))
        M = scipy.sparse.diags(np.load(os.path.join(operator, "M.npy"))).tocsc()

    start = time.perf_counter()
    theirs = np.sort(eigsh(L, arguments.pairs, M, sigma=-1e-8, tol=0)[0])
    seconds = time.perf_counter() - start
    difference = np.abs(ours - theirs).max() / theirs[-1]
    print(f"{arguments.points} points, {arguments.pairs} pairs, one thread")
    print(f"tufted  {report['seconds']:6.2f} s, {report['solver']['method']}, residual {report['residual']:.1e}")
    print(f"eigsh   {seconds:6.2f} s")
    print(f"ratio   {report['seconds'] / seconds:6.2f}, eigenvalues differ by {difference:.1e} of the largest")
    return 0 if report["seconds"] <= seconds / 2 and difference <= 1e-8 else 1


if __name__ == "__main__":
    sys.exit(main())
