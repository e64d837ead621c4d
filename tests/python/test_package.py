"""What is imported, and that stubs and docstrings agree with the signatures."""
import ast
import doctest
import inspect
import itertools
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import tufted
from support import CLOUD

FOLDER = pathlib.Path(tufted.__file__).parent
STUBS = ast.parse((FOLDER / "__init__.pyi").read_text())


def in_stub(node):
    """Names, defaults and kinds of the parameters of a function in the stub."""
    arguments = node.args
    positional = arguments.posonlyargs + arguments.args
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    found = [(a.arg, d and ast.unparse(d), "positional") for a, d in zip(positional, defaults)]
    found += [(a.arg, d and ast.unparse(d), "keyword") for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return found + ([(arguments.kwarg.arg, None, "rest")] if arguments.kwarg else [])


def in_code(function):
    kinds = {inspect.Parameter.KEYWORD_ONLY: "keyword", inspect.Parameter.VAR_KEYWORD: "rest"}

    def text(default):
        return None if default is inspect.Parameter.empty else ast.unparse(ast.parse(repr(default), mode="eval"))

    return [(p.name, text(p.default), kinds.get(p.kind, "positional"))
            for p in inspect.signature(function).parameters.values()]


def stub_functions():
    for node in STUBS.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    yield f"{node.name}.{member.name}", member


def code_of(name):
    found = tufted
    for part in name.split("."):
        found = inspect.getattr_static(found, part) if found is not tufted else getattr(found, part)
    return found


@pytest.mark.parametrize("name, node", list(stub_functions()))
def test_stubs_are_the_signatures(name, node):
    code = code_of(name)
    if isinstance(code, property):
        assert any(ast.unparse(d) == "property" for d in node.decorator_list)
        return
    assert in_stub(node) == in_code(code)


def test_the_stub_has_every_public_name():
    declared = {node.name for node in STUBS.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(tufted.__all__) == {name for name in declared if not name.startswith("_")}
    for node in STUBS.body:
        if isinstance(node, ast.ClassDef) and node.name in ("Surface", "PointCloud", "Mesh"):
            whole = getattr(tufted, node.name)
            # Surface has its parts in files of their own.
            classes = whole.__mro__[:-1] if node.name == "Surface" else [whole]
            members = {n for c in classes for n, v in vars(c).items()
                       if not n.startswith("_") and (callable(v) or isinstance(v, (property, staticmethod)))}
            assert members == {m.name for m in node.body if not m.name.startswith("_")}


def documented():
    for name in tufted.__all__:
        yield name, getattr(tufted, name)
        if inspect.isclass(getattr(tufted, name)):
            for member, value in inspect.getmembers(getattr(tufted, name)):
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    yield f"{name}.{member}", value


@pytest.mark.parametrize("name, value", list(documented()))
def test_docstrings_name_every_argument(name, value):
    assert value.__doc__, name
    if value is tufted.Surface:
        return  # not made by its users
    if isinstance(value, property) or (inspect.isclass(value) and "__init__" not in vars(value)):
        return
    text = value.__doc__ + (tufted.Surface.__doc__ if name.split(".")[0] in ("Surface", "PointCloud", "Mesh") else "")
    for other in ("All else as in point_cloud_laplacian", "Arguments and result are those of harmonic",
                  "as in PointCloud"):
        if other in text:
            text += tufted.point_cloud_laplacian.__doc__ + tufted.Surface.harmonic.__doc__ + tufted.PointCloud.__doc__
    if "with the same options" in text:
        text += tufted.Surface.gradients.__doc__
    if name.endswith("operators"):
        text += tufted.Surface.gradients.__doc__ + tufted.Surface.spectrum.__doc__
    if name == "load":
        text += tufted.PointCloud.__doc__
    if name.startswith(("Surface", "PointCloud", "Mesh")) or name in ("read", "load") or "laplacian" in name:
        text += " progress"
    function = value.__init__ if inspect.isclass(value) else value
    missing = [p for p in inspect.signature(function).parameters
               if p not in ("self", "options") and not re.search(rf"\b{p}\b", text)]
    short = {"p_ind", "p_inds", "v_ind", "v_inds", "V", "F", "path", "vector", "vectors", "values",
             "directory", "time_step", "k", "spectrum"}
    assert set(missing) <= short, f"{name}: {missing}"


EXAMPLES = [test for test in itertools.chain.from_iterable(
    doctest.DocTestFinder(exclude_empty=True).find(module, globs={"tufted": tufted, "np": np, "points": CLOUD})
    for name, module in sys.modules.items() if name.startswith("tufted._") and hasattr(module, "__file__")
    and module.__file__.endswith(".py")) if test.examples]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda test: test.name)
def test_examples_of_help_run(example):
    """`points` are those of a sphere."""
    assert doctest.DocTestRunner().run(example).failed == 0


def test_typed():
    assert (FOLDER / "py.typed").exists()


def test_neither_pcl_nor_vtk_is_loaded():
    extension = next(FOLDER.glob("_tufted*.so"))
    libraries = subprocess.run(["ldd", str(extension)], capture_output=True, text=True, check=True).stdout.lower()
    assert "libtbb" in libraries
    assert "pcl" not in libraries and "vtk" not in libraries


def test_import_takes_less_than_three_tenths_of_a_second():
    program = ("import time, numpy, scipy.sparse; start = time.perf_counter(); import tufted; "
               "print(time.perf_counter() - start)")
    seconds = [float(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True,
                                    env=os.environ).stdout) for _ in range(5)]
    assert min(seconds) < 0.3


def test_missing_packages_are_told_before_anything_is_compiled(tmp_path):
    source = pathlib.Path(__file__).resolve().parents[2] / "src" / "python"
    code = f"import sys; sys.path.insert(0, {str(source)!r}); import tufted_backend; tufted_backend.build_wheel('.')"
    # -S: without the folder that has the packages, as under pip's build isolation.
    run = subprocess.run([sys.executable, "-I", "-S", "-c", code], capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 1
    assert "finds no numpy and no scipy" in run.stderr
    assert run.stdout == "" and not list(tmp_path.iterdir())
