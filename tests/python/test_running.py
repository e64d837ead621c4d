"""Ctrl-C, progress, the interpreter's lock, and memory."""
import ctypes
import pathlib
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import tufted
from support import sphere, torus_mesh

# Ctrl-C comes some time after "begins", on a busy machine before the first call of progress. What ignores it goes on to
# the last stage.
INTERRUPTED = """
import numpy, sys, tufted
random = numpy.random.default_rng(1)
cloud, points = tufted.PointCloud(random.normal(size=(20000, 3))), random.normal(size=({count}, 3))
few, seen = [], []
work = lambda given, said: {work}
work(points[:500], few)
print("begins", flush=True)
try:
    work(points, seen)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    assert len(tufted.PointCloud(points[:500]).M) == 500  # all goes on
    sys.exit(7 if not seen or seen[-1][0] != few[-1][0] or seen[-1][1] < 0.9 else 1)
"""


@pytest.mark.parametrize("count, work", [
    (2_000_000, "tufted.PointCloud(given, progress=lambda *stage: said.append(stage))"),
    (5_000_000, "cloud.nearest(given, progress=lambda *stage: said.append(stage))")])
def test_ctrl_c_stops(count, work):
    child = subprocess.Popen([sys.executable, "-c", INTERRUPTED.format(count=count, work=work)],
                             stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begins\n"
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert out == "interrupted\n" and child.returncode == 7


def test_progress_is_called_and_may_stop():
    seen = []
    tufted.PointCloud(sphere(3000), progress=lambda stage, fraction: seen.append((stage, fraction)))
    assert len({stage for stage, _ in seen}) > 3
    assert all(isinstance(stage, str) and 0 <= fraction <= 1 for stage, fraction in seen)
    with pytest.raises(tufted.Cancelled):
        tufted.PointCloud(sphere(3000), progress=lambda stage, fraction: False)
    cloud = tufted.PointCloud(sphere(3000))
    for call in (cloud.distance, cloud.green):
        with pytest.raises(tufted.Cancelled):
            call(0, progress=lambda stage, fraction: False)
    with pytest.raises(tufted.Cancelled):
        cloud.points_within(0, 0.5, progress=lambda stage, fraction: False)
    for call in (cloud.validate, cloud.restricted_to, lambda **more: cloud.nearest(sphere(20), **more),
                 lambda **more: cloud.nearest(sphere(2000), **more)):
        with pytest.raises(tufted.Cancelled):
            call(progress=lambda stage, fraction: False)
        fractions = []
        call(progress=lambda stage, fraction: fractions.append(fraction))
        assert fractions
    assert np.isfinite(cloud.distance(0)).all()


def test_what_progress_raises_arrives():
    with pytest.raises(KeyError, match="stop"):
        tufted.PointCloud(sphere(3000), progress=lambda stage, fraction: {}["stop"])


def test_other_threads_go_on_meanwhile():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    tufted.PointCloud(sphere(100_000), threads=1)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 5


def memory():
    ctypes.CDLL(None).malloc_trim(0)  # what is free counts as free
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize()


def test_memory_is_flat_over_hundreds_of_builds():
    points = sphere(200)
    faces = np.array([[0, 1, 2], [1, 2, 3]])

    def use():
        L, M = tufted.point_cloud_laplacian(points, threads=1)
        cloud = tufted.PointCloud(points, threads=1)
        cloud.spectrum(3)
        cloud.distance(0)
        cloud.validate()
        tufted.Mesh(points, faces, threads=1).report
        with pytest.raises(tufted.InvalidInput):
            cloud.harmonic({0: np.nan})
        return L, M

    for _ in range(50):
        use()
    before = memory()
    for _ in range(400):
        use()
    assert memory() - before < 3.2e6


SETTINGS = {  # methods that keep what is costly, each with settings of which every value needs another
    "spectrum": lambda mesh, i: mesh.spectrum(44 - i),
    "hks": lambda mesh, i: mesh.hks(k=44 - i),
    "operators": lambda mesh, i: mesh.operators(44 - i),
    "embed": lambda mesh, i: mesh.embed(44 - i),
    "gradients": lambda mesh, i: mesh.gradients(regularization=1e-5 * i),
    "distance": lambda mesh, i: mesh.distance(0, maximum=1 + 0.1 * i),
    "split": lambda mesh, i: mesh.distance(0, split=i % 3),
    "heat": lambda mesh, i: mesh.distance(0, method="heat", time_step=1 + 0.1 * i),
    "nearest_source": lambda mesh, i: mesh.nearest_source([0, 9], maximum=1 + 0.1 * i),
    "extend": lambda mesh, i: mesh.extend([0, 9], [1.0, 2.0], time_step=1 + 0.1 * i),
    "transport": lambda mesh, i: mesh.transport(0, [1, 2, 3], time_step=1 + 0.1 * i),
    "log_map": lambda mesh, i: mesh.log_map(0, method="heat", time_step=1 + 0.1 * i),
    "signed_distance": lambda mesh, i: mesh.signed_distance([0, 20, 40], time_step=1 + 0.1 * i),
    "harmonic": lambda mesh, i: mesh.harmonic({0: 1.0, 9 + i: 2.0}),
    "poisson": lambda mesh, i: mesh.poisson(mesh.M, {0: 1.0, 9 + i: 2.0}),
    "smooth": lambda mesh, i: mesh.smooth(time_step=1 + 0.1 * i),
    "deform": lambda mesh, i: mesh.deform([0, 9 + i], np.zeros((2, 3)), method="linear"),
    "normals": lambda mesh, i: mesh.normals(viewpoint=[i, 2, 3]),
}


@pytest.mark.parametrize("name", SETTINGS)
def test_memory_is_flat_over_the_values_of_a_setting(name):
    mesh = tufted.Mesh(*torus_mesh(100, 50), threads=1)
    for i in range(10):
        SETTINGS[name](mesh, i)
    before, kept = memory(), len(mesh._kept)
    for i in range(10, 40):
        SETTINGS[name](mesh, i)
    assert len(mesh._kept) == kept
    assert memory() - before < 4e6  # thirty solvers take 30e6 and more
