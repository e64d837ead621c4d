#!/usr/bin/env python3
"""Times eigenpairs by `tufted spectrum` and by scipy's eigsh on the same matrices, on one thread, one after the other.

    tools/compare_eigsh.py build/release/tufted [--points 100000] [--pairs 64]

Needs python3-scipy. Prints the seconds of both by the clock and of CPU, which other programs disturb less, the ratio of
the latter, and how far the eigenvalues are apart; ends with 1 if ours takes more than half as long, or they differ by
more than a part in 10^8. The CPU of ours is that of the whole command, with reading and writing.
"""
import argparse
import json
import os
import resource
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
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run("spectrum", "--operator", operator, "--count", str(arguments.pairs), "--out", out)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        our_cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
            report = json.load(file)["report"]
        ours = np.load(os.path.join(out, "evals.npy"))
        L = scipy.sparse.load_npz(os.path.join(operator, "L.npz"))
        M = scipy.sparse.diags(np.load(os.path.join(operator, "M.npy"))).tocsc()

    start, start_cpu = time.perf_counter(), time.process_time()
    theirs = np.sort(eigsh(L, arguments.pairs, M, sigma=-1e-8, tol=0)[0])
    seconds, their_cpu = time.perf_counter() - start, time.process_time() - start_cpu
    difference = np.abs(ours - theirs).max() / theirs[-1]
    print(f"{arguments.points} points, {arguments.pairs} pairs, one thread")
    print(f"tufted  {report['seconds']:6.2f} s, CPU {our_cpu:6.2f} s, {report['solver']['method']}, "
          f"residual {report['residual']:.1e}, Gram {report['orthogonality']:.1e}")
    print(f"eigsh   {seconds:6.2f} s, CPU {their_cpu:6.2f} s")
    print(f"ratio   {our_cpu / their_cpu:6.2f} of CPU; eigenvalues differ by {difference:.1e} of the largest")
    return 0 if our_cpu <= their_cpu / 2 and difference <= 1e-8 else 1


if __name__ == "__main__":
    sys.exit(main())
