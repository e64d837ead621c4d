"""Compares the names and arguments of robust_laplacian and potpourri3d with ours: the table of docs/drop_in.md, which
`python3 tests/python/test_peers.py` prints.
"""
import inspect
import pathlib
import re

import pytest

import tufted

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs" / "drop_in.md"
# Names of theirs that have no counterpart here. A gap that is closed, or a new one, fails the test below.
MISSING = {"validate_mesh", "validate_points"}


def peers():
    """The project, name, arguments and remark of each line."""
    project = ""
    for line in (HERE / "peer_signatures.txt").read_text().splitlines():
        if line.startswith("["):
            project = line.strip("[]")
        elif line and not line.startswith("#"):
            name, arguments, remark = re.fullmatch(r"([\w.]+)\((.*?)\) \|(.*)", line).groups()
            yield project, name, [each for each in arguments.split(", ") if each], remark.strip()


def found(name):
    """Our function or class of this name, or None."""
    value = tufted
    for part in name.split("."):
        value = getattr(value, part, None)
    return value


def more(name, arguments):
    """The arguments that ours has beside theirs, which must come first, by the same names and in the same order."""
    ours = [p for p in inspect.signature(found(name)).parameters.values() if p.name != "self"]
    assert [p.name for p in ours[:len(arguments)]] == arguments, name
    rest = ours[len(arguments):]
    assert all(p.default is not p.empty or p.kind is p.VAR_KEYWORD for p in rest), name
    return [p.name for p in rest]


def table():
    lines = []
    project = None
    for owner, name, arguments, remark in peers():
        if owner != project:
            project = owner
            lines += [f"| {owner} | here | what differs |", "|---|---|---|"]
        if found(name) is None:
            lines.append(f"| `{name}` | no | {remark} |")
            continue
        also = more(name, arguments)
        also = "also " + ", ".join(f"`{each}`" for each in also) if also else ""
        lines.append(f"| `{name}` | yes | {'; '.join(filter(None, [remark, also]))} |")
    return re.sub(r"(?m)\n(?=\| potpourri3d)", "\n\n", "\n".join(lines))


@pytest.mark.parametrize("name, arguments", [(name, arguments) for _, name, arguments, _ in peers()])
def test_arguments_are_those_of_the_peer(name, arguments):
    assert (found(name) is None) == (name in MISSING)
    if found(name) is not None:
        more(name, arguments)


def test_the_table_of_the_page_is_current():
    assert table() in PAGE.read_text(), "python3 tests/python/test_peers.py prints the table for docs/drop_in.md"


if __name__ == "__main__":
    print(table())
