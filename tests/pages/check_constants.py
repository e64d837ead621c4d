#!/usr/bin/env python3
"""Compares the constants of src/ with the tables of docs/algorithm.md, which must explain each one.

A constant is a `constexpr` with a number in its value. A row of a table names it, its value as in the code, its file
below src/ or several, and why it has this value:
    | `name` | `value` | `room/file.cpp`, `room/other.h` | why |
Prints one line per fault: a constant without a row, a row without a constant, another value, or no reason.
"""
import pathlib
import re
import sys

DECLARATION = re.compile(r"\bconstexpr\s+([^;(){}=]*?)(\w+)\s*(\[[^;=]*\])?\s*=\s*([^;]*);", re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])(\d[\w.']*)")
FURTHER = re.compile(r"^\s*(\w+)\s*=\s*(.*)$", re.DOTALL)
ROW = re.compile(r"^\| `(\w+)` \| `([^`]+)` \| ((?:`[\w/]+\.(?:h|cpp)`(?:, )?)+) \|(.*)\|$")
MOST_NUMBERS = 4  # of a constant; what has more is a table, such as the fields of a file format


def without_comments(text):
    """The code alone, with one space per comment."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)


def declarators(value):
    """Splits 'a, least = 3' into the first value and what follows, at commas outside of brackets."""
    parts, depth, start = [], 0, 0
    for i, letter in enumerate(value):
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append(value[start:i])
            start = i + 1
    return parts + [value[start:]]


def constants_of(text):
    """Name and value of each constant in a file, in order."""
    found = []
    for _, name, _, value in DECLARATION.findall(without_comments(text)):
        first, *others = declarators(value)
        pairs = [(name, first)] + [match.groups() for match in map(FURTHER.match, others) if match]
        found += [(name, " ".join(value.split())) for name, value in pairs
                  if 0 < len(NUMBER.findall(value)) <= MOST_NUMBERS]
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    code = {}
    for path in sorted((root / "src").rglob("*")):
        if path.suffix in (".h", ".cpp"):
            for name, value in constants_of(path.read_text(encoding="utf-8")):
                code.setdefault((path.relative_to(root / "src").as_posix(), name), []).append(value)

    faults = []
    if not code:
        faults.append("src: has no constants at all")
    page = root / "docs" / "algorithm.md"
    rows = set()
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        match = ROW.match(line)
        if not match:
            continue
        name, value, files, why = match.groups()
        value = value.replace("\\|", "|")
        where = f"docs/algorithm.md:{number}: {name}"
        if not why.strip():
            faults.append(f"{where} has no reason")
        for file in re.findall(r"`([^`]+)`", files):
            if (file, name) not in code:
                faults.append(f"{where} is no constant of src/{file}")
            elif value not in code[file, name]:
                faults.append(f"{where} = {value}, src/{file} has {' and '.join(code[file, name])}")
            rows.add((file, name, value))
    for (file, name), values in code.items():
        for value in values:
            if (file, name, value) not in rows:
                faults.append(f"src/{file}: {name} = {value} is not explained in docs/algorithm.md")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
