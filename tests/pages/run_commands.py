#!/usr/bin/env python3
"""Runs every command of a page of the documentation, as a reader would.

    run_commands.py ROOT PAGE [BIN]     PAGE below ROOT; BIN is a folder that is put on the PATH

Each line of a ```sh fence runs in one scratch folder per page, in which `datasets` is that of ROOT; lines that end in a
backslash go on. A ```python fence runs there as a whole. A comment right above a fence says what else to do with it:
    <!-- tested as: COMMAND -->   runs COMMAND instead, in ROOT: for what installs, builds or takes minutes
    <!-- fails -->                every command must end with exit code 1 or 2
Prints one line per fault: a command that fails, a fence that nothing runs, a link to a file that does not exist.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^\s*```(.*)$")
NOTE = re.compile(r"^\s*<!-- (?:(fails)|tested as: (.*)) -->$")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
OTHERS = {"cpp", "cmake", "text", "json"}  # programs are compiled by tests/consumer
COMMAND = re.compile(r"^    (?:\$ |(?:build/release/)?tufted |tools/|cmake |ctest )")


def blocks_of(lines):
    """For each fence its language, the line of its first command, its lines, and the note above it."""
    note, start, language, found = None, None, None, []
    for number, line in enumerate(lines, 1):
        match = FENCE.match(line)
        if match and start is None:
            start, language = number + 1, match[1].strip()
        elif match:
            found.append((language, start, lines[start - 1:number - 1], note))
            start = note = None
        elif start is None:
            note = NOTE.match(line) or (note if not line.strip() else None)
    return found


def commands_of(start, lines):
    """Line number and text of each command, continued lines joined."""
    command, first = "", None
    for number, line in enumerate(lines, start):
        first = first or number
        command += line.strip()
        if command.endswith("\\"):
            command = command[:-1]
            continue
        if command and not command.startswith("#"):
            yield first, command
        command, first = "", None


def run(command, folder, path, language="sh"):
    """Exit code and output; a pipe fails where one of its commands does."""
    program = ["bash", "-o", "pipefail"] if language == "sh" else [sys.executable]
    done = subprocess.run([*program, "-c", command], cwd=folder, env=dict(os.environ, PATH=path), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout.strip()[-600:]


def main():
    root, page = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    path = os.pathsep.join([*sys.argv[3:], os.environ["PATH"]])
    lines = (root / page).read_text(encoding="utf-8").splitlines()
    faults, count = [], 0

    in_fence = False
    for number, line in enumerate(lines, 1):
        in_fence ^= bool(FENCE.match(line))
        if not in_fence and COMMAND.match(line):
            faults.append(f"{page}:{number}: a command outside of a ```sh fence is not run: {line.strip()}")
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if "://" not in target and not (root / page).parent.joinpath(target).exists():
                faults.append(f"{page}:{number}: no file {target}")

    with tempfile.TemporaryDirectory() as scratch:
        pathlib.Path(scratch, "datasets").symlink_to(root / "datasets")
        for language, start, text, note in blocks_of(lines):
            if language in OTHERS:
                continue
            if language not in ("sh", "python"):
                faults.append(f"{page}:{start - 1}: a fence of ```{language}, must be sh, python or one of "
                              f"{', '.join(sorted(OTHERS))}")
                continue
            fails, instead = note.groups() if note else (None, None)
            if instead:
                commands = [(start, instead)]
            elif language == "python":
                commands = [(start, "\n".join(text))]
            else:
                commands = commands_of(start, text)
            for number, command in commands:
                code, output = run(command, root if instead else scratch, path, "sh" if instead else language)
                count += 1
                if (code not in (1, 2)) if fails else code != 0:
                    faults.append(f"{page}:{number}: exit code {code}: {command}\n{output}")
    for fault in faults:
        print(fault)
    print(f"{page}: {count} commands")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
