"""Maps between two shapes: functional maps, their refinement, and maps from point to point."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import PointMaps, Signature
from ._surface import Surface
from ._tufted import InvalidInput

# Pairs and energies of the wave kernels that are compared unless the caller has descriptors: those of Aubry et al.
_PAIRS, _ENERGIES = 100, 100
# Distances between points that are computed at once; 16 MB, so that they stay near the processor.
_BLOCK = 4_000_000
# Default of `commutativity`. On the pairs of tests/python/test_maps.py with the seeds 1 to 7, maps of clouds are best
# from 0.01 to 0.1; with less they follow differences of the samples, with more they lose the descriptors.
_COMMUTATIVITY = 3e-2


def functional_map(source, target, descriptors=None, *, landmarks=(), weights=None, k=30, commutativity=_COMMUTATIVITY,
                   progress=None):
    """Finds the functional map that carries functions on one shape to another (Ovsjanikov, Ben-Chen, Solomon,
    Butscher, Guibas 2012): the matrix C that minimises |C A - B|^2 + commutativity |C D - E C|^2. Each row of C solves
    a system of its own. A and B are the coefficients of descriptors, scaled to norm 1, D and E the eigenvalues.

    Both shapes are scaled to area 1 for it, so they may have different units. A shape that is its own mirror image has
    two maps of equal cost, and the one found may be the mirrored one, or a mixture: give landmarks, some of them off
    the plane of symmetry.

    source, target: surfaces, clouds or meshes.
    descriptors: of the source N x D, and of the target N' x D, in a pair. Times of signatures must be in proportion to
    the areas of the shapes, and energies differ by the logarithm of their ratio, see hks() and wks(); a factor of times
    and a shift of energies is not checked, as the shapes may have different units. None: wave kernel signatures.
    landmarks: P x 2, an index on the source and the corresponding one on the target, of points that take part; adds
    wave kernels around them.
    weights: D values >= 0, one per column of `descriptors`, that multiply its misfit; None: ones.
    k: number of eigenpairs, zeros included; fewer if a shape has fewer.
    commutativity: >= 0; larger values ask more for a map that commutes with the Laplacians. Eigenvalues are divided by
    the largest one for it, and the misfit of descriptors by their number.
    progress: see Surface.
    Returns C, k x k: from the coefficients of a function on the source to those on the target, in bases of norm 1.

    >>> a, b = tufted.PointCloud(points), tufted.PointCloud(3 * points)
    >>> C = tufted.functional_map(a, b, landmarks=[[0, 0], [500, 500]], k=10)
    >>> C = tufted.zoom_out(a, b, C, k=40)
    >>> to_target, to_source = tufted.point_maps(a, b, C)
    >>> (to_source == np.arange(len(points))).all()
    True
    """
    name = "functional_map"
    shapes = _shapes(name, source, target)
    commutativity = check.number(name, "commutativity", commutativity)
    if not (commutativity >= 0 and np.isfinite(commutativity)):
        raise InvalidInput(f"{name}: commutativity = {commutativity:g}, must be finite and at least 0")
    k, progress = check.whole(name, "k", k, 1), check.callback(name, progress)
    bases = _bases(name, shapes, max(k, _PAIRS), progress)
    compared, weight = _compared(name, shapes, bases, descriptors, landmarks, weights)
    k = min(k, len(bases[0].values))
    A, B = (basis.coefficients(functions, k) * weight for basis, functions in zip(bases, compared))
    A, B = (part / np.sqrt(part.shape[1]) for part in (A, B))
    D, E = (basis.values[:k] for basis in bases)
    penalties = commutativity * ((D - E[:, None]) / max(D[-1], E[-1], np.finfo(float).tiny)) ** 2
    gram, right = A @ A.T, B @ A.T
    C = np.empty((k, k))
    for row in range(k):
        check.report(name, progress, row / k)
        C[row] = _least_solution(gram + np.diag(penalties[row]), right[row])
    return C


def zoom_out(source, target, start, *, k=100, step=1, samples=1000, progress=None):
    """Refines a map between two shapes by ZoomOut (Melzi, Ren, Rodola, Sharma, Wonka, Ovsjanikov 2019): in turn the map
    from point to point of a functional map, and the functional map with `step` more eigenpairs of that.

    source, target: surfaces, clouds or meshes.
    start: C of functional_map(), or to_source: for each point of the target one of the source, negative for none. A
    matrix of k rows or more is returned as it is.
    k: number of eigenpairs at the end; fewer if a shape has fewer.
    step: eigenpairs that each turn adds, >= 1; larger values are faster.
    samples: about so many points of the target, evenly spread, take part in the turns, at least 2 k, and ten times as
    many of the source; None: all.
    progress: see Surface.
    Returns C, k x k, as functional_map().
    """
    name = "zoom_out"
    shapes = _shapes(name, source, target)
    k, step = check.whole(name, "k", k, 1), check.whole(name, "step", step, 1)
    samples = None if samples is None else max(check.whole(name, "samples", samples, 1), 2 * k)
    progress, start = check.callback(name, progress), check.array(name, "start", start)
    first, second = bases = _bases(name, shapes, max(k, len(start) if start.ndim == 2 else 1), progress)
    k, points = min(k, len(first.values)), second.sample(samples)
    # Images are found among ten times as many points: a third of the spacing of the samples is near enough.
    candidates = first.sample(None if samples is None else 10 * samples)
    if start.ndim == 2:
        C = _matrix(name, "start", start, bases)
    else:
        C = second.pulled(first, points, _points(name, "start", start, shapes)[points], min(k, step))
    while len(C) < k:
        check.report(name, progress, len(C) / k)
        C = second.pulled(first, points, second.nearest_of(first, C, points, candidates), min(k, len(C) + step))
    return C


def point_maps(source, target, C, *, progress=None):
    """The maps from point to point in both directions that a functional map stands for: each point goes to the nearest
    one in the space of coefficients (Ovsjanikov et al. 2012, Section 6.1).

    source, target: surfaces, clouds or meshes. C: of functional_map() or zoom_out(). progress: see Surface.
    Returns to_target (N indices of points on the target) and to_source (N' indices of points on the source), -1 at
    isolated and non-finite points. Values on the source are carried to the target by values[to_source].
    """
    name = "point_maps"
    C = check.array(name, "C", C)
    bases = _bases(name, _shapes(name, source, target), len(np.atleast_2d(C)), check.callback(name, progress))
    C = _matrix(name, "C", C, bases)
    first, second = bases
    return PointMaps(first.nearest_of(second, C.T), second.nearest_of(first, C))


class _Basis:
    """The first k eigenpairs of a surface scaled to area 1, at all its points."""

    def __init__(self, function, surface, k, progress):
        area = surface.M.sum()
        if not area > 0:
            raise InvalidInput(f"{function}: a shape has the area 0, must have points that take part")
        values, vectors = surface._first_pairs(k, progress)
        self.values, self.vectors, self.masses = values * area, vectors * np.sqrt(area), surface.M / area
        self.takes_part = surface.status[surface.representative] == 0
        self.surface = surface

    def first(self, k):
        self.values, self.vectors = self.values[:k], self.vectors[:, :k]

    def norms(self, functions):
        return np.sqrt(self.masses @ functions**2)

    def coefficients(self, functions, k):
        """The first k coefficients, k x D, of functions divided by their norms."""
        norms = self.norms(functions)
        return self.vectors[:, :k].T @ (self.masses[:, None] * functions) / np.where(norms > 0, norms, 1)

    def wave_weights(self, energies, width):
        """k x E weights of eigenpairs at energies; 0 for the null space."""
        logarithms = np.log(np.where(self.values > 0, self.values, 1))[:, None]
        weights = np.exp(-((logarithms - energies) / width) ** 2 / 2) * (self.values > 0)[:, None]
        return weights / weights.sum(axis=0)

    def nearest_of(self, other, C, points=None, candidates=None):
        """For some points that of the candidates on another shape which C, from its coefficients to those here, brings
        nearest; None: all points. -1 for points that take no part.
        """
        points = np.arange(len(self.vectors)) if points is None else points
        candidates = np.flatnonzero(other.surface.status == 0) if candidates is None else candidates
        found = np.full(len(points), -1, np.int32)
        # Single precision: neighbours differ by far more, and it is three times as fast.
        places = other.vectors[candidates, :C.shape[1]].T.astype(np.float32)
        squares = (places**2).sum(axis=0)
        block = max(1, _BLOCK // len(candidates))
        asking = np.flatnonzero(self.takes_part[points])
        for rows in np.split(asking, range(block, len(asking), block)):
            asked = (self.vectors[points[rows], :len(C)] @ C).astype(np.float32)
            found[rows] = candidates[(squares - 2 * asked @ places).argmin(axis=1)]
        return found

    def pulled(self, other, points, mapped, k):
        """C, k x k, that fits best to a map from some points here to those of another shape; negative ones are left
        out.
        """
        known = mapped >= 0
        return np.linalg.lstsq(self.vectors[points[known], :k], other.vectors[mapped[known], :k], rcond=None)[0]

    def sample(self, count):
        """About `count` points that take part, evenly spread over the surface; all if there are no more."""
        points = np.flatnonzero(self.takes_part & (self.masses > 0))
        if count is None or len(points) <= count:
            return points
        positions = self.surface.positions[points]
        # A Poisson disk sample has 0.7 points per square of its spacing, as `tufted.thin` draws it.
        return points[_tufted.thin(positions, np.sqrt(0.7 * self.surface.M[points].sum() / count))]


def _shapes(function, source, target):
    for name, shape in (("source", source), ("target", target)):
        if not isinstance(shape, Surface):
            raise InvalidInput(f"{function}: {name} is a {type(shape).__name__}, must be a PointCloud or a Mesh")
    return source, target


def _bases(function, shapes, k, progress):
    """Bases of equally many pairs, at most k."""
    bases = [_Basis(function, shape, k, progress) for shape in shapes]
    least = min(len(basis.values) for basis in bases)
    for basis in bases:
        basis.first(least)
    return bases


def _least_solution(matrix, right):
    """The solution of least norm; several descriptors may be too few for a regular matrix."""
    from scipy.linalg import lstsq  # slow to import
    return lstsq(matrix, right, cond=len(matrix) * np.finfo(float).eps, lapack_driver="gelsy", check_finite=False)[0]


def _matrix(function, name, value, bases):
    table, flat = check.columns(function, name, value, len(np.atleast_1d(value)))
    most = len(bases[0].values)
    if flat or not table.size or table.shape[0] != table.shape[1]:
        raise InvalidInput(f"{function}: {name} has the shape {' x '.join(map(str, np.shape(value)))}, must be k x k")
    if len(table) > most:
        raise InvalidInput(f"{function}: {name} has {len(table)} rows, must have at most {most}, the eigenpairs that "
                           "both shapes have")
    if not np.isfinite(table).all():
        raise InvalidInput(f"{function}: {name} has a value that is not finite")
    return table


def _points(function, name, value, shapes):
    points = check.integers(function, name, value)
    source, target = shapes
    if points.shape != (len(target),) or points.max(initial=-1) >= len(source):
        raise InvalidInput(f"{function}: {name} must be a matrix, or {len(target)} indices below {len(source)}, one "
                           "for each point of the target")
    if points.max(initial=-1) < 0:
        raise InvalidInput(f"{function}: {name} has no index of at least 0, must have one")
    return points


def _compared(function, shapes, bases, descriptors, landmarks, weights):
    """Functions on both shapes that correspond, N x D each, and D weights."""
    energies, width = _shared_energies(bases)
    waves = [basis.wave_weights(energies, width) for basis in bases]
    if descriptors is None:
        if weights is not None:
            raise InvalidInput(f"{function}: weights is given, must be None without descriptors")
        given = [basis.vectors**2 @ wave for basis, wave in zip(bases, waves)]
    else:
        given = _pair(function, shapes, descriptors)
    count = given[0].shape[1]
    weight = np.ones(count) if weights is None else check.columns(function, "weights", weights, count)[0][:, 0]
    if not ((weight >= 0) & np.isfinite(weight)).all():
        raise InvalidInput(f"{function}: weights has {weight.min():g}, must be finite and at least 0")
    pairs = check.integers(function, "landmarks", landmarks)
    if pairs.size and (pairs.ndim != 2 or pairs.shape[1] != 2):
        raise InvalidInput(f"{function}: landmarks has the shape {' x '.join(map(str, pairs.shape))}, must be P x 2")
    pairs = pairs.reshape(-1, 2)
    columns = []
    for side, (shape, basis, wave) in enumerate(zip(shapes, bases, waves)):
        places = check.indices(function, "landmarks", pairs[:, side], len(shape), empty=True)
        outside = places[~basis.takes_part[places]]
        if outside.size:
            raise InvalidInput(f"{function}: landmarks has {outside[0]}, a point of the {('source', 'target')[side]} "
                               "that takes no part")
        around = [basis.vectors @ (wave * basis.vectors[place][:, None]) for place in places]
        columns.append(np.hstack([given[side], *around]))
    weight = np.concatenate([np.sqrt(weight), np.ones(columns[0].shape[1] - count)])
    if not np.logical_and.reduce([weight > 0, *(basis.norms(part) > 0 for basis, part in zip(bases, columns))]).any():
        raise InvalidInput(f"{function}: descriptors have no column that is not 0 and has a weight above 0, must have "
                           "one")
    return columns, weight


def _shared_energies(bases):
    """Energies that lie within the spectra of both shapes, and the width of Aubry et al., seven steps."""
    positive = [basis.values[basis.values > 0] for basis in bases]
    if min(map(len, positive)) < 2:
        raise InvalidInput("functional_map: fewer than two eigenvalues are positive: too few points take part")
    low, high = max(values[0] for values in positive), min(values[-1] for values in positive)
    energies = np.linspace(np.log(min(low, high)), np.log(max(low, high)), _ENERGIES)
    return energies, max(7 * (energies[1] - energies[0]), 1e-8)  # as in wks()


def _pair(function, shapes, descriptors):
    if not isinstance(descriptors, (tuple, list)) or len(descriptors) != 2:
        raise InvalidInput(f"{function}: descriptors must be a pair, of the source and of the target")
    computed = [vars(each) for each in descriptors if isinstance(each, Signature) and vars(each)]
    if len(computed) == 2 and not _agree(*computed):
        raise InvalidInput(f"{function}: descriptors are signatures at different times or energies, must have times in "
                           "proportion to the areas, or energies shifted by the logarithm of their ratio, and the same "
                           "width: first = a.hks(), b.hks(first.times * b.M.sum() / a.M.sum())")
    tables = [check.columns(function, "descriptors", each, len(shape))[0] for each, shape in zip(descriptors, shapes)]
    if tables[0].shape[1] != tables[1].shape[1]:
        raise InvalidInput(f"{function}: descriptors have {tables[0].shape[1]} and {tables[1].shape[1]} columns, must "
                           "have as many")
    takes_part = [(shape.status[shape.representative] == 0)[:, None] for shape in shapes]
    tables = [np.where(part, table, 0) for part, table in zip(takes_part, tables)]
    if not all(np.isfinite(table).all() for table in tables):
        raise InvalidInput(f"{function}: descriptors have a value that is not finite at a point that takes part")
    return tables


def _agree(first, second):
    """Whether signatures are computed at times in one proportion, or at energies that are shifted: the shapes may have
    different units.
    """
    if first.keys() != second.keys():
        return False
    a, b = (each["times" if "times" in first else "energies"] for each in (first, second))
    if a.shape != b.shape:
        return False
    if "times" in first:
        return np.allclose(a * b.sum(), b * a.sum(), rtol=1e-9, atol=0)
    return np.allclose(a - a.mean(), b - b.mean(), atol=1e-9) and np.isclose(first["width"], second["width"])
