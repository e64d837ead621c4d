"""Forked and spawned workers, and how many threads there are."""
import json
import os
import subprocess
import sys

import pytest

# All methods of a cloud that solve, each from nothing. Not slower than needed, yet large enough for CHOLMOD's loops.
METHODS = """
import hashlib, json, multiprocessing, os, signal, sys
import numpy as np
import scipy.sparse.linalg
import tufted

def sphere(count):
    points = np.random.default_rng(5).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)

POINTS = sphere(4000)
METHODS = {
    "spectrum": lambda cloud: cloud.spectrum(12).vectors,
    "operators": lambda cloud: cloud.operators(8)["evecs"],
    "heat": lambda cloud: cloud.distance(0, method="heat"),
    "marching": lambda cloud: cloud.distance(0),
    "harmonic": lambda cloud: cloud.harmonic({0: 1.0, 7: 2.0}),
    "biharmonic": lambda cloud: cloud.biharmonic({0: 1.0, 7: 2.0}),
    "poisson": lambda cloud: cloud.poisson(cloud.points[:, 2]),
    "smooth": lambda cloud: cloud.smooth(),
    "smooth_values": lambda cloud: cloud.smooth_values(cloud.points),
    "weights": lambda cloud: cloud.weights([0, 7]),
    "extend": lambda cloud: cloud.extend([0, 7], [1.0, 2.0]),
    "transport": lambda cloud: cloud.transport(0, [1, 2, 3]),
    "trace": lambda cloud: cloud.trace(0, [1, 2, 3], 2).points,
    "log_map": lambda cloud: cloud.log_map(0).coordinates,
    "deform": lambda cloud: cloud.deform([0, 7], [[2, 0, 0], [0, 2, 0]], method="linear").points,
    "segments": lambda cloud: cloud.segments(3, method="spectral").labels,
    "curvature": lambda cloud: cloud.curvature().mean,
    "path": lambda cloud: cloud.path(0, 7).points,
    "triangles": lambda cloud: cloud.triangles(),
    "nearest": lambda cloud: cloud.nearest(POINTS[:5]),
    "validate": lambda cloud: np.array([cloud.validate()["ok"]]),
    "denoise": lambda cloud: tufted.denoise(cloud.points, threads=cloud._solving["threads"]).points,
}

def results(threads):
    \"\"\"A checksum of what each method returns.\"\"\"
    sums = {}
    for name, call in METHODS.items():
        cloud = tufted.PointCloud(POINTS, threads=threads)
        sums[name] = hashlib.sha256(np.ascontiguousarray(call(cloud)).tobytes()).hexdigest()
    return sums
"""

FORKS = METHODS + """
def work(threads, connection):
    signal.alarm(200)  # ends a child that hangs
    connection.send(results(threads))
    connection.close()

def by_multiprocessing(kind, threads):
    context = multiprocessing.get_context(kind)
    receiver, sender = context.Pipe(False)
    child = context.Process(target=work, args=(threads, sender))
    child.start()
    sender.close()
    try:
        found = receiver.recv()
    except EOFError:
        found = None
    child.join()
    return found, child.exitcode

def by_os_fork(threads):
    receiver, sender = multiprocessing.Pipe(False)
    child = os.fork()
    if child == 0:
        receiver.close()
        work(threads, sender)
        sys.exit(0)  # with all that runs at an exit
    sender.close()
    try:
        found = receiver.recv()
    except EOFError:
        found = None
    return found, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

if __name__ == "__main__":
    kind, threads = sys.argv[1], int(sys.argv[2])
    expected = results(threads)
    for _ in range(2):  # the parent works on after a fork
        found, code = by_os_fork(threads) if kind == "os.fork" else by_multiprocessing(kind, threads)
        assert code == 0, f"the child ended with {code}"
        assert found == expected, [name for name in expected if found[name] != expected[name]]
        assert results(threads) == expected
    print("done")
"""

COUNTS = METHODS.replace("import tufted", "", 1) + """
import threading

def count():
    return len(os.listdir("/proc/self/task"))

most, is_done = 0, threading.Event()
def watch():
    global most
    while not is_done.is_set():
        most = max(most, count())

before = count()
watcher = threading.Thread(target=watch, daemon=True)
watcher.start()
import tufted
results(1)
after = count()
is_done.set()
watcher.join()
print(json.dumps({"before": before, "most": most - 1, "after": after - 1}))
"""


def run(tmp_path, script, *arguments):
    path = tmp_path / "script.py"
    path.write_text(script)
    done = subprocess.run([sys.executable, path, *arguments], stdout=subprocess.PIPE, text=True, env=os.environ)
    assert done.returncode == 0
    return done.stdout


@pytest.mark.parametrize("threads", ["1", "2"])
@pytest.mark.parametrize("kind", ["fork", "os.fork", "forkserver", "spawn"])
def test_a_child_of_a_parent_that_has_solved_computes_the_same(tmp_path, kind, threads):
    assert run(tmp_path, FORKS, kind, threads) == "done\n"


def test_one_thread_starts_no_other(tmp_path):
    counts = json.loads(run(tmp_path, COUNTS))
    assert counts["most"] == counts["after"] == counts["before"], counts
