#!/usr/bin/env python3
"""Plants one fault at a time in a small sound project and expects check_constants.py to name exactly that one."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parents[1] / "support"))
from planted import run_checker  # noqa: E402

CHECKER = pathlib.Path(__file__).with_name("check_constants.py")

PAGE = "docs/algorithm.md"
SOUND = {
    "src/base/scaling.cpp": "constexpr double farthest = 1e70;  // spreads\nconstexpr int bits = 16, few = 1 << bits;\n"
                            "constexpr double nan = std::numeric_limits<double>::quiet_NaN();\n"
                            "// constexpr int gone = 3;\nconstexpr int table[] = {1, 2, 3, 4, 5};\n",
    "src/stars/sheets.cpp": "  static constexpr std::array<int, 2> few_neighbors = {8, 13};\n"
                            "constexpr int bits = 16;\nif constexpr (is_wide) f(7);\n",
    PAGE: "# The algorithm\n| constant | value | file | why |\n|---|---|---|---|\n"
          "| `farthest` | `1e70` | `base/scaling.cpp` | squares must fit |\n"
          "| `bits` | `16` | `base/scaling.cpp`, `stars/sheets.cpp` | a word |\n"
          "| `few` | `1 << bits` | `base/scaling.cpp` | a table of them |\n"
          "| `few_neighbors` | `{8, 13}` | `stars/sheets.cpp` | on one sheet |\n",
}

# file, text in it, what it becomes, part of the fault that must be named
FAULTS = [
    ("src/base/scaling.cpp", "1e70", "1e71", "farthest = 1e70, src/base/scaling.cpp has 1e71"),
    ("src/base/scaling.cpp", "few = 1 << bits", "few = 1 << 15", "few = 1 << bits, src/base/scaling.cpp has 1 << 15"),
    ("src/stars/sheets.cpp", "{8, 13}", "{8, 14}", "few_neighbors = {8, 13}, src/stars/sheets.cpp has {8, 14}"),
    ("src/stars/sheets.cpp", "bits = 16", "words = 16", "bits is no constant of src/stars/sheets.cpp"),
    ("src/stars/sheets.cpp", "int bits", "int steep = 2, bits", "src/stars/sheets.cpp: steep = 2 is not explained"),
    (PAGE, "| `few` | `1 << bits` | `base/scaling.cpp` | a table of them |\n", "", "few = 1 << bits is not explained"),
    (PAGE, "| squares must fit |", "| |", "farthest has no reason"),
    (PAGE, "`farthest`", "`nearest`", "nearest is no constant of src/base/scaling.cpp"),
]


def run(tree):
    """Exit code and lines of the checker on a project of these files."""
    return run_checker(CHECKER, tree)


problems = []
if run(SOUND)[0] != 0:
    problems.append(f"the sound project is refused: {run(SOUND)[1]}")
if run({PAGE: SOUND[PAGE]})[0] == 0:
    problems.append("a project without constants passes")
for file, text, becomes, expected in FAULTS:
    assert SOUND[file].count(text) == 1, text
    code, lines = run(SOUND | {file: SOUND[file].replace(text, becomes)})
    if code == 0 or not any(expected in line for line in lines):
        problems.append(f"{file} with {becomes!r}: expected {expected!r}, got {lines}")
for problem in problems:
    print(problem)
sys.exit(1 if problems else 0)
