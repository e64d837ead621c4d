#!/usr/bin/env python3
"""Reads the includes of the project and names every one that runs backwards.

    rooms of src/ know those that ROOMS says, which lie before them; cover/, which is the paper, knows base/ only
    io knows public headers only; python those of io and view as well; tools know public headers and the fixtures of the tests,
    the benchmark (tools/bench) also the rooms that it measures
    public headers know Eigen and the standard library only (those in tufted/pcl also PCL, in tufted/mpi also PETSc)
    nothing in the library writes to a stream
    no two headers of the library define a type of one name, which would break the one-definition rule
"""
import pathlib
import re
import sys

# The folders of src/, each with those that it may include.
ROOMS = {
    "base": [],
    "simd": [],
    "polygons": ["base"],
    "cover": ["base"],
    "neighbors": ["base", "simd"],
    "stars": ["base", "simd", "neighbors"],
    "direct": ["base", "simd", "cover", "neighbors", "stars"],
    "depth_image": ["base", "simd", "neighbors", "stars"],
    "denoise": ["base", "simd", "neighbors", "stars", "depth_image"],
    "pipeline": ["base", "cover", "neighbors", "stars", "depth_image", "denoise", "direct"],
    "operators": ["base", "cover", "stars"],
    "tiles": ["base", "cover", "neighbors", "stars", "direct", "pipeline", "operators"],
    "algorithms": ["base", "simd", "cover", "neighbors", "stars", "operators"],
    "view": [],
    "pcl": [],
    "mpi": ["base", "cover", "io", "operators"],
    "python": [],
}
FIXTURES = ["shapes", "oracles", "guarantees"]  # folders of tests/ that tools for developers may use
FOREIGN = {"pcl": "pcl/", "mpi": "petsc"}  # what public headers of a part may include besides
SUFFIXES = {".h", ".hpp", ".cpp"}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^\s()\\]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-zA-Z])\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
STREAM = re.compile(
    r"\bstd::w?(?:cout|cerr|clog)\b|\b(?:stdout|stderr)\b"
    r"|(?<![\w.>])(?:std::|::)?(?:v?f?printf|f?puts|f?putc|putchar|perror)\s*\(")

# A type that is defined at the left margin.
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?: :[^;]*)? \{$", re.MULTILINE)


def part_of(name):
    """Where a public header belongs: "core", "io", "mpi", "view" or "pcl"."""
    parts = name.split("/")
    return parts[1] if len(parts) > 2 and parts[1] in ("io", "mpi", "pcl", "view") else "core"


def is_standard(name):
    """<vector> and <cstdint>, but not <omp.h> or <pcl/point_types.h>."""
    return "/" not in name and "." not in name


def public_fault(header, name):
    own, other = part_of(header), part_of(name)
    if name.startswith("tufted/"):
        visible = ["core", own]
        return None if other in visible else f"{own} headers may not include {name}"
    if name == "iostream":
        return "public headers do not include <iostream>"
    if is_standard(name) or name.startswith("Eigen/") or name.startswith(FOREIGN.get(own, "Eigen/")):
        return None
    return f"public headers do not include {name}"


def source_fault(room, name, quoted):
    if name.startswith("tufted/"):
        other = part_of(name)
        visible = {"python": ["core", "io", "view"], "mpi": ["core", "io", "mpi"]}.get(room, ["core", room])
        return None if other in visible else f"{room} may not include {name}"
    if name == "iostream":
        return "the library does not include <iostream>"
    if not quoted:
        return None
    other = name.split("/")[0]
    if room == "io":
        return None if other == "io" else f"io may include public headers and its own only, not {name}"
    if other not in [*ROOMS, "io"]:
        return f"{name} is in no room"
    return None if other in (room, *ROOMS[room]) else f"{room} may not include {name}"


def tool_fault(path, name, quoted):
    if not quoted or name.startswith("tufted/") or name.split("/")[0] in FIXTURES or (path.parent / name).is_file():
        return None
    if "bench" in path.parent.parts[-2:] and name.split("/")[0] in ["bench", *ROOMS]:
        return None
    return f"tools may include public headers only, not {name}"


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES) if folder.is_dir() else []


def check(root):
    """The faults in the project at `root`, as lines `path: what is wrong`."""
    faults = []

    def report(path, fault):
        if fault:
            faults.append(f"{path.relative_to(root)}: {fault}")

    def includes(path):
        code = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        return [(quoted or angle, bool(quoted)) for quoted, angle in INCLUDE.findall(code)]

    def check_streams(path):
        code = COMMENT_OR_TEXT.sub('""', path.read_text(encoding="utf-8"))
        for match in STREAM.finditer(code):
            report(path, f"the library writes to no stream: {match.group().strip()}")

    public = files(root / "include" / "tufted")
    for path in public:
        header = path.relative_to(root / "include").as_posix()
        for name, _ in includes(path):
            report(path, public_fault(header, name))
        check_streams(path)

    sources = files(root / "src")
    for path in sources:
        room = path.relative_to(root / "src").parts[0]
        if room not in [*ROOMS, "io"]:
            report(path, f"{room} is no room")
            continue
        for name, quoted in includes(path):
            report(path, source_fault(room, name, quoted))
        check_streams(path)

    for path in files(root / "tools"):
        for name, quoted in includes(path):
            report(path, tool_fault(path, name, quoted))

    defined = {}
    for path in public + sources:
        if path.suffix not in (".h", ".hpp") or "python" in path.parts:
            continue
        for name in TYPE.findall(path.read_text(encoding="utf-8")):
            if name in defined:
                report(path, f"{name} is a type of {defined[name]}, too")
            defined[name] = path.relative_to(root)

    if not public or not sources:
        faults.append(f"{root}: holds no include/tufted or no src")
    return faults


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found) if found else "every include runs the right way")
    sys.exit(1 if found else 0)
