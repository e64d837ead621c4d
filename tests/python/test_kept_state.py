"""What a surface keeps: the same bits for any number of threads, pickles, and the factors of its solvers."""
import pickle
import threading

import numpy as np
import pytest

import tufted
from support import CLOUD, same


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_do_not_change_the_bits(cloud, threads):
    other = tufted.PointCloud(CLOUD, threads=threads)
    assert same(other.L, cloud.L) and np.array_equal(other.M, cloud.M)
    np.testing.assert_array_equal(other.distance(0), cloud.distance(0))


def test_several_threads_at_once(cloud):
    expected, found = cloud.distance(3), [None] * 4

    def ask(k):
        found[k] = tufted.PointCloud(CLOUD).distance(3) if k % 2 else cloud.distance(3)

    threads = [threading.Thread(target=ask, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for values in found:
        np.testing.assert_array_equal(values, expected)


@pytest.mark.parametrize("which", ["cloud", "mesh"])
def test_pickling_keeps_all(which, request):
    surface = request.getfixturevalue(which)
    again = pickle.loads(pickle.dumps(surface, protocol=5))
    assert type(again) is type(surface) and repr(again) == repr(surface)
    assert same(again.L, surface.L) and np.array_equal(again.M, surface.M)
    assert again.report == surface.report
    np.testing.assert_array_equal(again.distance(0), surface.distance(0))
    np.testing.assert_array_equal(again.frames, surface.frames)
    np.testing.assert_array_equal(again.smooth(), surface.smooth())
    assert again.validate()["ok"]


def test_methods_keep_their_factors(cloud):
    for call in (lambda: cloud.distance(0), lambda: cloud.green(0), lambda: cloud.extend(0, 1.0),
                 lambda: cloud.transport(0, [1, 2, 3]), lambda: cloud.log_map(0), lambda: cloud.gradients()):
        call()
        kept = dict(cloud._kept)
        call()
        assert cloud._kept == kept


def test_other_values_at_the_same_pins_need_no_factor(cloud):
    """The solver that is kept is the same object; another one's bits are those of a fresh cloud."""
    fresh = tufted.PointCloud(CLOUD)
    cases = [
        ("harmonic", lambda surface, k: surface.harmonic([0, 5], [1.0, 3.0 + k])),
        ("harmonic", lambda surface, k: surface.poisson(CLOUD[:, 2], [0, 5], [1.0, 3.0 + k])),
        ("biharmonic", lambda surface, k: surface.biharmonic({0: 1.0, 5: 3.0 + k, 9: 2.0})),
        ("smooth", lambda surface, k: surface.smooth(CLOUD * (1 + k), iterations=1 + k)),
    ]
    for name, call in cases:
        first = call(cloud, 0)
        kept = cloud._kept[name][1]
        second = call(cloud, 1)
        assert cloud._kept[name][1] is kept, name
        np.testing.assert_array_equal(first, call(fresh, 0))
        fresh._kept.clear()
        np.testing.assert_array_equal(second, call(fresh, 1))
        assert not np.array_equal(first, second)


def test_of_factors_for_pins_the_last_one_is_kept(cloud):
    stages = []
    record = lambda stage, fraction: stages.append(stage)  # noqa: E731

    def has_factored(call):
        stages.clear()
        call()
        assert stages
        return "factor" in stages

    fixed = np.arange(3000) < 10
    for call in (lambda pins: cloud.harmonic(pins, [1.0, 2], progress=record),
                 lambda pins: cloud.biharmonic(pins, [1.0, 2], progress=record),
                 lambda pins: cloud.poisson(CLOUD[:, 0], pins, [1.0, 2], progress=record),
                 lambda pins: cloud.smooth(fixed=np.isin(np.arange(3000), pins), progress=record)):
        cloud._kept.clear()
        assert [has_factored(lambda: call(pins)) for pins in ([3, 4], [3, 4], [3, 9], [3, 9], [3, 4])] == [
            True, False, True, False, True]
    assert has_factored(lambda: cloud.smooth(time_step=2, fixed=fixed, progress=record))
    assert has_factored(lambda: cloud.smooth(time_step=2, progress=record))
    assert not has_factored(lambda: cloud.smooth(time_step=2, iterations=2, progress=record))


def test_errors_name_the_method_though_the_factor_is_made_apart(cloud):
    beside = tufted.PointCloud(np.vstack([CLOUD, [[1e6, 0, 0]]]), solver="multigrid")
    for name in ("harmonic", "biharmonic"):
        with pytest.raises(tufted.InvalidInput, match=f"^{name}: pins has no point on a component"):
            getattr(beside, name)([3000], [1.0])
    with pytest.raises(tufted.InvalidInput, match="^poisson: pins has no point"):
        beside.poisson(np.zeros(3001), [3000], [1.0])
    with pytest.raises(tufted.SolverFailure, match="^biharmonic: multigrid is not fit"):
        beside.biharmonic([0], [1.0])
    with pytest.raises(tufted.InvalidInput, match="^smooth: time_step = -1, must be finite"):
        cloud.smooth(time_step=-1)
    np.testing.assert_allclose(beside.smooth()[:3000], cloud.smooth(), atol=1e-10)  # by multigrid
