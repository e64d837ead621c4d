"""Maps between two shapes: functional maps, their refinement, and maps from point to point."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import PointMaps, Signature
from ._surface import Surface
from ._tufted import InvalidInput

# Eigenpairs of wave kernels that are compared, as Aubry et al. take.
_PAIRS = 100


@check.public
def functional_map(source, target, descriptors=None, *, landmarks=(), weights=None, k=30, commutativity=0.03,
                   progress=None):
    """Finds the functional map that carries functions on one shape to another (Ovsjanikov, Ben-Chen, Solomon,
    Butscher, Guibas 2012): the matrix C that minimises |C A - B|^2 / D + commutativity |C E - E' C|^2 / e^2. A and B
    are the coefficients of D descriptors, scaled to norm 1, E and E' the eigenvalues, and e is the largest of them.

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
    commutativity: >= 0; larger values ask more for a map that commutes with the Laplacians.
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
    k, progress = check.whole(name, "k", k, 1), check.callback(name, progress)
    if descriptors is None:
        if weights is not None:
            raise InvalidInput(f"{name}: weights is given, must be None without descriptors")
        descriptors = [np.zeros((len(shape), 0)) for shape in shapes]
    else:
        descriptors = _pair(name, shapes, descriptors)
    if weights is None:
        weights = np.zeros(0)
    else:
        weights = check.columns(name, "weights", weights, descriptors[0].shape[1])[0][:, 0]
    pairs = check.integers(name, "landmarks", landmarks)
    if pairs.size and (pairs.ndim != 2 or pairs.shape[1] != 2):
        raise InvalidInput(f"{name}: landmarks has the shape {' x '.join(map(str, pairs.shape))}, must be P x 2")
    return _tufted.functional_map(*_parts(shapes, max(k, _PAIRS), progress), *descriptors, weights, pairs, k,
                                  commutativity, progress)


@check.public
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
    samples = 0 if samples is None else check.whole(name, "samples", samples, 1)
    progress, start = check.callback(name, progress), check.array(name, "start", start)
    if start.ndim == 2:
        zoom_out, start = _tufted.zoom_out, _matrix(name, "start", start)
    else:
        zoom_out, start = _tufted.zoom_out_points, _points(name, "start", start, shapes)
    most = max(k, len(start) if start.ndim == 2 else 1)
    with check.named(name, C="start", to_source="start"):
        return zoom_out(*_parts(shapes, most, progress), start, k, step, samples, source._solving["threads"], progress)


@check.public
def point_maps(source, target, C, *, progress=None):
    """The maps from point to point in both directions that a functional map stands for: C carries points
    of the source into the space of the target's coefficients, and the nearest ones there correspond (Ovsjanikov et al.
    2012, Section 6.1).

    source, target: surfaces, clouds or meshes. C: of functional_map() or zoom_out(). progress: see Surface.
    Returns to_target (N indices of points on the target) and to_source (N' indices of points on the source), -1 at
    isolated and non-finite points. Values on the source are carried to the target by values[to_source].
    """
    name = "point_maps"
    shapes, C, progress = _shapes(name, source, target), _matrix(name, "C", C), check.callback(name, progress)
    return PointMaps(*_tufted.point_maps(*_parts(shapes, len(C), progress), C, source._solving["threads"], progress))


def _shapes(function, source, target):
    for name, shape in (("source", source), ("target", target)):
        if not isinstance(shape, Surface):
            raise InvalidInput(f"{function}: {name} is a {type(shape).__name__}, must be a PointCloud or a Mesh")
    return source, target


def _parts(shapes, k, progress):
    """The Laplacian and at most k eigenpairs of each shape."""
    if not all(shape.M.sum() > 0 for shape in shapes):
        raise InvalidInput("maps: a shape has the area 0, must have points that take part")
    return [part for shape in shapes for part in (shape._laplacian, shape._first_pairs(k, progress))]


def _matrix(function, name, value):
    value = check.array(function, name, value)
    table, flat = check.columns(function, name, value, len(np.atleast_1d(value)))
    if flat or not table.size or table.shape[0] != table.shape[1]:
        raise InvalidInput(f"{function}: {name} has the shape {' x '.join(map(str, np.shape(value)))}, must be k x k")
    return table


def _points(function, name, value, shapes):
    points = check.integers(function, name, value)
    source, target = shapes
    if points.shape != (len(target),) or points.max(initial=-1) >= len(source):
        raise InvalidInput(f"{function}: {name} must be a matrix, or {len(target)} indices below {len(source)}, one "
                           "for each point of the target")
    return points


def _pair(function, shapes, descriptors):
    if not isinstance(descriptors, (tuple, list)) or len(descriptors) != 2:
        raise InvalidInput(f"{function}: descriptors must be a pair, of the source and of the target")
    computed = [vars(each) for each in descriptors if isinstance(each, Signature) and vars(each)]
    if len(computed) == 2 and not _agree(*computed):
        raise InvalidInput(f"{function}: descriptors are signatures at different times or energies, must have times in "
                           "proportion to the areas, or energies shifted by the logarithm of their ratio, and the same "
                           "width: first = a.hks(), b.hks(first.times * b.M.sum() / a.M.sum())")
    return [check.columns(function, "descriptors", each, len(shape))[0] for each, shape in zip(descriptors, shapes)]


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
