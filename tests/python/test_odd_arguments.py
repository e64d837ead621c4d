"""Whatever an argument is, a function takes it or says in InvalidInput, with its own name, what is wrong."""
import inspect

import numpy as np
import pytest

import tufted

ODD = {
    "number": 5, "negative": -3, "fraction": 1.5, "not a number": float("nan"), "huge": 2**70, "complex": 1j,
    "none": None, "boolean": True, "text": "abc", "bytes": b"abc", "object": object(), "class": int, "function": len,
    "dict": {"a": 1}, "dict of indices": {0: 1.0}, "set": {1, 2}, "empty": [], "iterator": iter([0, 1]),
    "floats": np.array([0.5, 1.5]), "complex numbers": np.array([1j, 2]), "texts": ["a", "b"], "list of none": [None],
    "index and text": [0, "a"], "objects": [object()], "ragged": [[1, 2], [3]], "nested": [[[0, 1], [1, 0]]],
    "deep": [[[[0]]]], "no rows": np.zeros((0, 4)), "out of range": [0, 10**6],
    "dates": np.array(["2020-01-01"], "datetime64[D]"), "records": np.zeros(2, [("a", "f4")]),
}
CALLBACKS = ("progress", "gain")  # what a function raises that these call is the caller's own error

# A bumpy sheet.
X, Y = (each.ravel() for each in np.meshgrid(np.linspace(0, 1, 8), np.linspace(0, 1, 8), indexing="ij"))
POINTS = np.stack([X, Y, 0.2 * np.sin(3 * X) * np.sin(3 * Y)], axis=1)
AT = np.arange(64).reshape(8, 8)
FACES = np.concatenate([np.stack([AT[:-1, :-1], AT[1:, :-1], AT[1:, 1:]], axis=-1).reshape(-1, 3),
                        np.stack([AT[:-1, :-1], AT[1:, 1:], AT[:-1, 1:]], axis=-1).reshape(-1, 3)])

# Arguments of usual calls by name, and those of single functions in which a name means something else.
USUAL = {
    "sources": [0], "source": 0, "start": 0, "end": 1, "points": [0, 9], "direction": [1, 0, 0], "length": 0.1,
    "radius": 0.5, "field": X, "values": [0.1], "f": X, "handles": [0, 9], "pins": [0, 9], "vectors": [[1, 0, 0]],
    "curve": AT[3], "positions": POINTS[:2], "directory": "folder", "filename": "file.ply", "size": (16, 16), "k": 8,
    "targets": POINTS[:2], "steps": 1, "max_iterations": 3, "verts": POINTS, "faces": FACES, "V": POINTS, "F": FACES,
    "P": POINTS, "v_ind": 0, "v_inds": [0], "p_ind": 0, "p_inds": [0], "curves": [AT[3]], "cloud_normals": POINTS,
    "vector": [1, 0], "u": X, "v_start": 0, "v_end": 5, "v_list": [0, 9, 20], "start_vert": 0, "start_face": 0,
    "direction_xyz": [1, 0, 0], "bary_coords": [1, 1, 1], "spacing": 0.1, "path": "file.ply", "target": tufted.Mesh(
        POINTS, FACES),
}
SURFACES = {"PointCloud": tufted.PointCloud(POINTS), "Mesh": USUAL["target"]}
CURVE = {"curves": [[(int(place), []) for place in AT[3]]]}
OWN = {
    **{name: {"points": POINTS} for name in ("PointCloud", "Mesh", "denoise", "thin", "point_cloud_laplacian")},
    **{name: {"values": [1.0, 2.0]} for name in ("harmonic", "biharmonic")},
    **{name: {"values": POINTS} for name in ("smooth_values", "filter", "picture", "page")},
    **{name: {"source": USUAL["target"], "start": np.eye(8), "C": np.eye(8)}
       for name in ("functional_map", "zoom_out", "point_maps")},
    "transport_tangent_vectors": {"vectors": [[1, 0]]}, "divergence": {"vectors": np.ones((64, 2))},
    "signed_distance": {"sources": ()}, "laplacian_by_tiles": {"source": POINTS, "out": "tiles"},
    "MeshSignedHeatSolver.compute_distance": CURVE, "MeshFastMarchingDistanceSolver.compute_distance": CURVE,
}
# Arguments with defaults that usual calls have as well: without them some fail, and others take long.
GIVEN = ("sources", "curve", "size", "k", "steps", "max_iterations")


def _functions():
    """The name, the class if it is a method, and the function of all that is public, results and errors left out."""
    for name in tufted.__all__:
        found = getattr(tufted, name)
        if not inspect.isclass(found):
            yield name, None, found
        elif not issubclass(found, (tuple, str, np.ndarray, Exception)) and found is not tufted.Surface:
            yield name, None, found
            for method, function in inspect.getmembers(found, inspect.isfunction):
                if not method.startswith("_"):
                    yield f"{name}.{method}", found, function


FUNCTIONS = {name: (owner, function) for name, owner, function in _functions()}


def usual(name, function):
    """The arguments of a usual call."""
    own = {**OWN.get(name.split(".")[-1], {}), **OWN.get(name, {})}
    parameters = {argument: each for argument, each in inspect.signature(function).parameters.items()
                  if argument not in ("self", "options")}
    return {argument: own[argument] if argument in own else USUAL[argument] for argument, each in parameters.items()
            if argument in own or argument in GIVEN or each.default is inspect.Parameter.empty}, list(parameters)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The current folder, with a result and a file."""
    monkeypatch.chdir(tmp_path)
    SURFACES["Mesh"].save("folder", formats=("npz", "ply", "cover"))
    tufted.write_mesh(POINTS, FACES, "file.ply")


def bound(name):
    """What a user calls, its usual arguments, and the names of all."""
    owner, function = FUNCTIONS[name]
    call = function
    if owner is not None:
        object_of = SURFACES.get(owner.__name__) or owner(**usual(owner.__name__, owner)[0])
        call = getattr(object_of, name.split(".")[1])
    return call, *usual(name, function)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", FUNCTIONS)
def test_odd_arguments_are_taken_or_named(name, folder):
    call, given, arguments = bound(name)
    call(**given)
    for argument in arguments:
        for kind, odd in ODD.items():
            if argument in CALLBACKS and kind in ("class", "function"):
                continue
            try:
                call(**{**given, argument: odd})
            except (tufted.InvalidInput, tufted.SolverFailure) as error:
                assert str(error).startswith(name.split(".")[-1] + ": "), f"{argument}, {kind}"
            except tufted.IoError:
                pass
            except Exception as error:
                pytest.fail(f"{argument}, {kind}: {error!r}")


def test_a_picture_is_saved_to_names_alone():
    picture = SURFACES["Mesh"].picture(size=(16, 16))
    for number in (1, True, 7.5, None):  # files by their number would be closed
        with pytest.raises(tufted.InvalidInput, match="^save: path = .*, must be the name of a file or folder"):
            picture.save(number)
