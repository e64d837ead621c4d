"""Checks arguments and converts them to the arrays that the library takes. Messages name the function and the
argument.
"""
import contextlib
import functools
import inspect
import os
import re

import numpy as np
import scipy.sparse

from ._tufted import Cancelled, InvalidInput, IoError, SolverFailure

_LARGEST = 2**31 - 1


# Arguments of robust_laplacian, potpourri3d and read(), and what messages of other functions call them.
_OURS = {
    "verts": ["points"], "mollify_factor": ["mollify"], "n_neighbors": ["neighbors"], "P": ["points"], "V": ["points"],
    "F": ["faces"], "p_ind": ["sources", "source"], "p_inds": ["sources"], "v_ind": ["sources", "source"],
    "v_inds": ["sources"], "vector": ["vectors"], "curves": ["curve"], "v_start": ["start"], "v_end": ["end"],
    "v_list": ["points"], "start_vert": ["source"], "start_face": ["source"], "direction_xyz": ["direction"],
    "bary_coords": ["barycentric"], "u": ["field"], "isoval": ["values"], "thin": ["spacing"],
}


@contextlib.contextmanager
def named(function, **names):
    """Gives errors raised within the name of the function that the user called. `names` maps our names of arguments
    to those of that function.
    """
    try:
        yield
    except (InvalidInput, SolverFailure) as error:
        what = re.sub(r"^[\w:]+: ", "", str(error))
        for ours, theirs in names.items():
            if what.startswith(ours + " "):
                what = theirs + what[len(ours):]
                break
        raise type(error)(f"{function}: {what}") from None


def public(function):
    """Gives errors of a function, or of the constructor and the public methods of a class, the name that the user
    called, also where they come from another function.
    """
    if inspect.isclass(function):
        for name, method in list(vars(function).items()):
            if inspect.isfunction(method) and (name == "__init__" or not name.startswith("_")):
                setattr(function, name, public(method))
        return function
    arguments = inspect.signature(function).parameters
    names = {ours: theirs for theirs in arguments for ours in _OURS.get(theirs, ()) if ours not in arguments}

    @functools.wraps(function)
    def called(*given, **options):
        is_constructor = function.__name__ == "__init__"
        with named(type(given[0]).__name__ if is_constructor else function.__name__, **names):
            return function(*given, **options)
    return called


def array(function, name, value):
    if np.ma.is_masked(value):
        raise InvalidInput(f"{function}: {name} is masked at {np.ma.count_masked(value)} places, must have all its "
                           "values (array.compressed() leaves the others out)")
    try:
        return np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise InvalidInput(f"{function}: {name} is no array: {error}") from None


def _numbers(function, name, value):
    if np.ma.is_masked(value) and value.dtype.kind in "fiu":  # masked entries become NaN, which takes no part
        value = value.astype(np.float64).filled(np.nan)
    found = array(function, name, value)
    if found.size == 0 and found.dtype == object:
        found = found.astype(np.float64)
    if found.dtype.kind not in "fiu":
        raise InvalidInput(f"{function}: {name} has dtype {found.dtype}, must be real numbers")
    return np.ascontiguousarray(found, dtype=np.float64) if found.ndim else found.astype(np.float64)


def _shape(array):
    return " x ".join(str(length) for length in array.shape) or "()"


def values(function, name, value):
    """One number or several, as a one-dimensional float64 array."""
    array = _numbers(function, name, value)
    if array.ndim > 1:
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be one number or a list")
    return array.reshape(-1)


def rows_of_three(function, name, value, rows=None, or_one=False):
    """N x 3 float64 in C order; such an array is not copied. With or_one three values are one row."""
    array = _numbers(function, name, value)
    if or_one and array.shape == (3,):
        array = array[None]
    if array.size == 0 and array.ndim < 2:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3 or rows not in (None, array.shape[0]):
        wanted = "N" if rows is None else rows
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be {wanted} x 3")
    return array


def vector_of_three(function, name, value):
    array = _numbers(function, name, value)
    if array.shape != (3,):
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be 3")
    return array


def integers(function, name, value):
    """Integers of any type as int32, whatever their shape."""
    found = array(function, name, value)
    if found.size == 0:
        return found.astype(np.int32)
    if found.dtype.kind not in "iu":
        raise InvalidInput(f"{function}: {name} has dtype {found.dtype}, must be integers")
    lowest, highest = found.min(), found.max()
    if lowest < -_LARGEST - 1 or highest > _LARGEST:
        raise InvalidInput(f"{function}: {name} has {lowest if lowest < 0 else highest}, must fit into 32 bits")
    return np.ascontiguousarray(found, dtype=np.int32) if found.ndim else found.astype(np.int32)


def indices(function, name, value, count, empty=False):
    """One or several indices in [0, count), as a one-dimensional int32 array."""
    array = integers(function, name, value)
    if array.ndim > 1:
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be one index or a list")
    array = array.reshape(-1)
    if array.size == 0 and not empty:
        raise InvalidInput(f"{function}: {name} is empty, must name at least one point")
    wrong = array[(array < 0) | (array >= count)]
    if wrong.size:
        raise InvalidInput(f"{function}: {name} has {wrong[0]}, must lie in [0, {count})")
    return array


def lists_of_indices(function, name, value, count):
    """Several lists of indices in [0, count), as int32 arrays."""
    return [indices(function, name, each, count) for each in items(function, name, value)]


def triangles(function, name, value):
    """F x 3 int32 in C order."""
    array = integers(function, name, value)
    if array.size == 0 and array.ndim < 2:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be F x 3")
    return array


def columns(function, name, value, rows):
    """`rows` values, or `rows` x c. Returns a two-dimensional float64 array, and whether the caller's had one
    dimension.
    """
    array = _numbers(function, name, value)
    if array.ndim == 0 and rows == 1:
        array = array.reshape(1)
    if array.ndim not in (1, 2) or array.shape[0] != rows:
        raise InvalidInput(f"{function}: {name} has the shape {_shape(array)}, must be {rows} or {rows} x c")
    return array[:, None] if array.ndim == 1 else array, array.ndim == 1


def pins(function, pins_given, values, count):
    """Indices, values (P x c), and whether values had one dimension. From a dict, or from indices with `values`."""
    if values is None:
        if not isinstance(pins_given, dict):
            raise InvalidInput(f"{function}: values is None, must be given unless pins is a dict of values by index")
        pins_given, values = list(pins_given.keys()), list(pins_given.values())
    where = indices(function, "pins", pins_given, count)
    table, flat = columns(function, "values", values, where.size)
    return where, table, flat


def number(function, name, value):
    """A real number."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InvalidInput(f"{function}: {name} = {value!r}, must be a number")
    return float(value)


def whole(function, name, value, least):
    """An integer of at least `least`."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise InvalidInput(f"{function}: {name} = {value!r}, must be an integer")
    if not least <= value <= _LARGEST:
        raise InvalidInput(f"{function}: {name} = {value}, must be at least {least}"
                           if value < least else f"{function}: {name} = {value}, must fit into 32 bits")
    return int(value)


def flag(function, name, value):
    """A boolean; None and numbers count as Python takes them."""
    try:
        return bool(value)
    except (TypeError, ValueError):  # an array, say
        raise InvalidInput(f"{function}: {name} = {value!r}, must be True or False") from None


def items(function, name, value):
    """The items of a list, or of anything else that has some; a text has none."""
    try:
        if isinstance(value, (str, bytes, dict)):
            raise TypeError
        return list(value)
    except TypeError:
        raise InvalidInput(f"{function}: {name} = {value!r}, must be a list") from None


def text(function, name, value):
    if not isinstance(value, str):
        raise InvalidInput(f"{function}: {name} is a {type(value).__name__}, must be a text")
    return value


def callback(function, value):
    if value is not None and not callable(value):
        raise InvalidInput(f"{function}: progress = {value!r}, must be None or a function of stage and fraction")
    return value


def report(function, progress, fraction):
    """Calls `progress` with the name of a function of the package, which computes in Python, as its stage."""
    if progress is not None and progress(function, fraction) is False:
        raise Cancelled(f"{function}: progress returned False")


def path(function, name, value):
    """The name of a file or folder. Numbers, by which open() takes files that are open already, are refused."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise InvalidInput(f"{function}: {name} = {value!r}, must be the name of a file or folder") from None


def write(file_name, content):
    """Writes bytes to a file, which is replaced; raises IoError with its name."""
    try:
        with open(file_name, "wb") as file:
            file.write(content)
    except (OSError, ValueError) as error:  # ValueError: a name with the character 0
        raise IoError(f"{file_name}: cannot write: {getattr(error, 'strerror', None) or error}") from None


def sparse(parts, size):
    """A csc_matrix that shares the memory of its three arrays."""
    matrix = scipy.sparse.csc_matrix(parts, shape=(size, size), copy=False)
    matrix.has_sorted_indices = matrix.has_canonical_format = True
    return matrix
