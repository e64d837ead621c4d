#!/usr/bin/env python3
"""Counts the constants of src/ and prints how many each room has, and the total.

A constant is a `constexpr` with one to four numbers in its value; what has more is a table, such as the fields of a file
format. A declaration with parentheses in its type is not seen. One command, from anywhere in the project:
    python3 tools/bench/count_constants.py [ROOT]
"""
import pathlib
import re
import sys

DECLARATION = re.compile(r"\bconstexpr\s+([^;(){}=]*?)(\w+)\s*(\[[^;=]*\])?\s*=\s*([^;]*);", re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])(\d[\w.']*)")
FURTHER = re.compile(r"^\s*(\w+)\s*=\s*(.*)$", re.DOTALL)
MOST_NUMBERS = 4


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


def count_by_room(src):
    """The number of constants in each folder below src that has any."""
    counts = {}
    for path in sorted(src.rglob("*")):
        if path.suffix in (".h", ".cpp"):
            room = path.parent.relative_to(src).as_posix()
            counts[room] = counts.get(room, 0) + len(constants_of(path.read_text(encoding="utf-8")))
    return {room: count for room, count in counts.items() if count > 0}


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
    counts = count_by_room(root / "src")
    for room, count in counts.items():
        print(f"{count:4} {room}")
    print(f"{sum(counts.values()):4} in total")


if __name__ == "__main__":
    main()
