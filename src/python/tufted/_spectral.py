"""The methods of Surface that use eigenvalues and eigenvectors."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Spectrum, signature
from ._tufted import InvalidInput

_LEAST_WIDTH = 1e-8  # of wks(): that of waveKernelSignature() in C++, far above the rounding of logarithms


@check.public
class Spectral:
    def spectrum(self, k=None, *, null_space=True, tolerance=1e-10, progress=None):
        """The k smallest eigenvalues of L x = lambda M x, with their eigenvectors.

        The null space is exact: the eigenvalue 0 once for each component. Vectors are M-orthonormal, and the largest
        entry of each is positive.

        k: number of pairs, at most the number of active points of positive area; None: 32, or as many as there are.
        null_space: False leaves out the eigenvalues 0 and returns the k smallest positive ones.
        tolerance: relative accuracy of vectors, in (0, 1).
        Returns values (k, ascending, 1/length^2) and vectors (N x k, 1/length; 0 at isolated and non-finite points).
        """
        pairs = self._pairs(self._count(k, 32, null_space), null_space, tolerance, progress)
        return Spectrum(pairs.values, pairs.vectors)

    def hks(self, times=None, *, k=100, samples=16, spectrum=None, progress=None):
        """The heat kernel signature of every point: sum of exp(-lambda t) phi(x)^2 over the null space and k further
        eigenpairs (Sun, Ovsjanikov, Guibas 2009).

        times: T values >= 0, length^2; None: `samples` times at which k pairs suffice, evenly spaced on a logarithmic
        scale. They follow from the eigenvalues, so each surface has its own: to compare two, give the second one the
        `times` of the first one's result, times the ratio of the areas: b.hks(first.times * b.M.sum() / a.M.sum()).
        k: number of positive eigenvalues; all if there are fewer. The last result of spectrum() is
        used if it has as many.
        spectrum: a result of spectrum(), used instead of k.
        Returns N x T, 1/length^2, with the times as its attribute `times`.

        >>> a, b = tufted.PointCloud(points), tufted.PointCloud(2 * points)
        >>> first = a.hks(k=20)
        >>> second = b.hks(4 * first.times, k=20)  # areas are four times as large
        >>> np.allclose(first, 4 * second)
        True
        """
        pairs = self._positive("hks", k, spectrum, progress)
        if times is None:
            times = _tufted.heat_times(pairs, check.whole("hks", "samples", samples, 1))
        else:
            times = check.values("hks", "times", times)
        return signature(_tufted.hks(self._laplacian, pairs, times), times=times)

    def wks(self, energies=None, *, width=None, k=100, samples=100, spectrum=None, progress=None):
        """The wave kernel signature of every point: a weighted mean of phi(x)^2 over eigenvalues near each energy
        (Aubry, Schlickewei, Cremers 2011).

        energies: E natural logarithms of eigenvalues; None: `samples` of them, evenly spaced between those of the
        smallest and the largest positive eigenvalue, so each surface has its own: to compare two, give the second one
        the width of the first one's result, and b.wks(first.energies - np.log(b.M.sum() / a.M.sum()), ...).
        width: standard deviation of the energy; None: seven times the distance between the first two energies.
        k, spectrum: as in hks().
        Returns N x E, 1/length^2, with the attributes `energies` and `width`.
        """
        pairs = self._positive("wks", k, spectrum, progress)
        if energies is None:
            energies = _tufted.wave_energies(pairs, check.whole("wks", "samples", samples, 2))
            width = max(7 * (energies[1] - energies[0]), _LEAST_WIDTH) if width is None else width
        else:
            energies = check.values("wks", "energies", energies)
        if width is None:
            if energies.size < 2:
                raise InvalidInput("wks: width = None, must be given for fewer than two energies")
            width = 7 * abs(energies[1] - energies[0])
        width = check.number("wks", "width", width)
        return signature(_tufted.wks_at(pairs, energies, width), energies=energies, width=width)

    def embed(self, dimension=None, *, distance="commute", progress=None):
        """Places every point so that Euclidean distances are spectral distances, one coordinate per positive
        eigenvalue.

        dimension: number of coordinates; None: 3, or as many as there are.
        distance: "commute" (commute times, no unit) or "biharmonic" (length).
        Returns N x dimension.
        """
        if dimension is not None:
            check.whole("embed", "dimension", dimension, 1)
        with check.named("embed", k="dimension"):
            pairs = self._pairs(self._count(dimension, 3, False), False, 1e-10, progress)
        return _tufted.embed(pairs, check.text("embed", "distance", distance))

    def filter(self, values, *, k=100, gain=None, spectrum=None, progress=None):
        """Filters functions on the points by their frequencies: the mean over each component is kept, the part along
        each of the first k eigenvectors is multiplied by a factor, and the rest is removed.

        values: N or N x c, finite at active points.
        gain: a function of an eigenvalue (1/length^2) that returns this factor; None: 1, a low-pass filter.
        k, spectrum: as in hks().
        Returns the shape of values; isolated and non-finite points keep their values.
        """
        table, flat = check.columns("filter", "values", values, len(self))
        if gain is not None and not callable(gain):
            raise InvalidInput(f"filter: gain = {gain!r}, must be None or a function of an eigenvalue")
        result = _tufted.filter(self._laplacian, self._positive("filter", k, spectrum, progress), table, gain)
        return result[:, 0] if flat else result

    def _pairs(self, k, null_space, tolerance, progress):
        k = check.whole("spectrum", "k", k, 1)
        tolerance = check.number("spectrum", "tolerance", tolerance)
        settings = k, check.flag("spectrum", "null_space", null_space), tolerance
        return self._keep("spectrum", lambda: _tufted.spectrum(
            self._laplacian, *settings, self._solver(), check.callback("spectrum", progress)), settings)

    def _count(self, k, usual, null_space):
        """k or, if it is None, `usual`, but at most as many as there are."""
        return k if k is not None else max(1, min(usual, _tufted.most_eigenpairs(
            self._laplacian, check.flag("spectrum", "null_space", null_space))))

    def _positive(self, function, k, spectrum, progress):
        """Pairs of positive eigenvalues: those of `spectrum`, or the first k if it is None."""
        if spectrum is not None:
            pair = check.items(function, "spectrum", spectrum)
            if len(pair) != 2:
                raise InvalidInput(f"{function}: spectrum has {len(pair)} items, must be values and vectors")
            vectors, _ = check.columns(function, "spectrum", pair[1], len(self))
            return _tufted.Spectrum(check.values(function, "spectrum", pair[0]), vectors).positive()
        most = _tufted.most_eigenpairs(self._laplacian, False)
        if most < 1:
            raise InvalidInput(f"{function}: no eigenvalue is positive, must be one: too few points take part")
        k = min(check.whole(function, "k", k, 1), most)
        kept = self._kept_pairs()
        pairs = kept and kept.positive()
        if pairs is None or len(pairs.values) < k:
            return self._pairs(k, False, 1e-10, progress)
        return _tufted.Spectrum(pairs.values[:k], pairs.vectors[:, :k])

    def _first_pairs(self, k, progress):
        """The first k pairs, zeros included, or as many as there are; those of the last result of spectrum() if they
        suffice.
        """
        k = self._count(None, k, True)
        kept = self._kept_pairs()
        if kept is None or len(kept.values) < k:
            return self._pairs(k, True, 1e-10, progress)
        return _tufted.Spectrum(kept.values[:k], kept.vectors[:, :k])

    def _kept_pairs(self):
        """The pairs of the last call of spectrum() with its defaults for all but k, or None."""
        (_, *settings), pairs = self._kept.get("spectrum", ((0, True, 1e-10), None))
        return pairs if settings == [True, 1e-10] else None
