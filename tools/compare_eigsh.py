#!/usr/bin/env python3
"""Times eigenpairs by `tufted spectrum` and by scipy's eigsh on the same matrices, on one thread, one after the other.

    tools/compare_eigsh.py build/release/tufted [--points 100000] [--pairs 64]

Needs python3-scipy. Both run with several tolerances. Of each run it prints the seconds by the clock and of CPU, which
other programs disturb less, the residual, the greatest |L x - lambda M x| / (lambda |M x|) of positive eigenvalues, and
how far the Gram matrix X^T M X is off the identity; both are computed here, from what either returns. The CPU of ours
is that of the whole command, with reading and writing.

Compared is at equal accuracy: ours by default with the cheapest run of eigsh whose residual is as small, and eigsh with
its default, tol=0, with the cheapest run of ours whose residual is as small, up to a factor of two. Ends with 1 if the former takes us
more than half as long, or the eigenvalues differ by more than a part in 10^8.
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

OUR_TOLERANCES = (1e-10, 1e-12, 1e-14)  # the first is the default
THEIR_TOLERANCES = (0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4)  # the first is the default: the machine's precision


def sphere(points):
    """Random points on the unit sphere, evenly distributed."""
    rows = np.random.default_rng(1).normal(size=(points, 3))
    return rows / np.linalg.norm(rows, axis=1)[:, None]


class Result:
    """One run, and how accurate it is."""

    def __init__(self, name, seconds, cpu, values, vectors, L, M):
        order = np.argsort(values)
        self.name, self.seconds, self.cpu, self.values = name, seconds, cpu, values[order]
        vectors = vectors[:, order]
        weighted = M @ vectors
        self.gram = np.abs(vectors.T @ weighted - np.eye(len(values))).max()
        positive = self.values > 1e-9 * self.values[-1]  # theirs are not exactly 0
        weighted = weighted[:, positive] * self.values[positive]
        rest = L @ vectors[:, positive] - weighted
        self.residual = (np.linalg.norm(rest, axis=0) / np.linalg.norm(weighted, axis=0)).max()

    def __str__(self):
        return (f"{self.name:28} {self.seconds:7.2f} s, CPU {self.cpu:7.2f} s, "
                f"residual {self.residual:.1e}, Gram {self.gram:.1e}")


def ours(command, folder, operator, pairs, tolerance, L, M):
    out = os.path.join(folder, "out")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([command, "spectrum", "--operator", operator, "--count", str(pairs), "--out", out, "--tolerance",
                    str(tolerance), "--threads", "1"], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
        report = json.load(file)["report"]
    return Result(f"tufted --tolerance {tolerance:g}", report["seconds"],
                  after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
                  np.load(os.path.join(out, "evals.npy")), np.load(os.path.join(out, "evecs.npy")), L, M)


def theirs(pairs, tolerance, L, M):
    start, start_cpu = time.perf_counter(), time.process_time()
    values, vectors = eigsh(L, pairs, M, sigma=-1e-8, tol=tolerance)
    seconds, cpu = time.perf_counter() - start, time.process_time() - start_cpu
    return Result(f"eigsh tol={tolerance:g}", seconds, cpu, values, vectors, L, M)


def compare(ours_at, theirs_at):
    """A line on two runs, and the ratio of their CPU; None where one of them did not become as exact as the other."""
    if ours_at is None or theirs_at is None:
        return "none of the others reaches that residual", None
    ratio = ours_at.cpu / theirs_at.cpu
    return f"{ours_at.name} / {theirs_at.name}: {ratio:.2f} of CPU", ratio


def cheapest(results, residual):
    """The fastest run of as small a residual; None where there is none."""
    return min((result for result in results if result.residual <= 2 * residual), key=lambda result: result.cpu,
               default=None)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tufted")
    parser.add_argument("--points", type=int, default=100000)
    parser.add_argument("--pairs", type=int, default=64)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cloud, operator = (os.path.join(folder, name) for name in ("sphere.xyz", "operator"))
        np.savetxt(cloud, sphere(arguments.points))
        subprocess.run([arguments.tufted, "laplacian", cloud, "--out", operator, "--format", "npz"], check=True,
                       stdout=subprocess.DEVNULL)
        L = scipy.sparse.load_npz(os.path.join(operator, "L.npz"))
        M = scipy.sparse.diags(np.load(os.path.join(operator, "M.npy"))).tocsc()
        our_runs = [ours(arguments.tufted, folder, operator, arguments.pairs, tolerance, L, M)
                    for tolerance in OUR_TOLERANCES]
    their_runs = [theirs(arguments.pairs, tolerance, L, M) for tolerance in THEIR_TOLERANCES]

    print(f"{arguments.points} points, {arguments.pairs} pairs, one thread")
    for result in our_runs + their_runs:
        print(result)
    our_default, their_default = our_runs[0], their_runs[0]
    line, ratio = compare(our_default, cheapest(their_runs, our_default.residual))
    print(f"at our residual    {line}")
    print(f"at that of tol=0   {compare(cheapest(our_runs, their_default.residual), their_default)[0]}")
    difference = np.abs(our_default.values - their_default.values).max() / their_default.values[-1]
    print(f"eigenvalues differ by {difference:.1e} of the largest")
    return 0 if ratio is not None and ratio <= 0.5 and difference <= 1e-8 else 1


if __name__ == "__main__":
    sys.exit(main())
