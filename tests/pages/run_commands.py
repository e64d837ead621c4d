#!/usr/bin/env python3
"""Runs every command of a page of the documentation, as a reader would.

    run_commands.py ROOT PAGE [BIN]     PAGE below ROOT; BIN is a folder that is put on the PATH

Each line of a ```sh fence runs in one scratch folder per page, in which `datasets` is that of ROOT; lines that end in a
backslash go on. A ```python fence runs there as a whole. A comment right above a fence says what else to do with it:
    <!-- tested as: COMMAND -->   runs COMMAND instead, in ROOT: for what installs, builds or takes minutes
    <!-- tested by: FILE -->      runs nothing: FILE, a path below ROOT, runs the commands
    <!-- fails -->                every command must end with exit code 1
    <!-- fails: 2 -->             every command must end with exit code 2, or another
Prints one line per fault: a command that fails or takes too long, a fence that nothing runs, a note that is misspelt or
stands above no commands, a link to a file or a heading that does not exist. A program in Python that imports a module
which this python lacks is left out.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SECONDS = 300  # that a command may take
FENCE = re.compile(r"^\s*```(.*)$")
NOTE = re.compile(r"^\s*<!-- (fails|fails: \d+|tested as: .+|tested by: .+) -->$")
LIKE_NOTE = re.compile(r"^\s*<!--\s*(?:fail|test)", re.IGNORECASE)
HEADING = re.compile(r"^#+ (.*)$")
LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")
OTHERS = {"cpp", "cmake", "text", "json"}  # programs are compiled by tests/consumer
COMMAND = re.compile(r"^    (?:\$ |(?:build/release/)?tufted |tools/|cmake |ctest )")


def blocks_of(lines):
    """For each fence its language, the line of its first command, its lines, and the note above it; and the line and
    text of each fault of fences and notes."""
    note, start, language, found, faults = None, None, None, [], []
    for number, line in enumerate(lines, 1):
        match = FENCE.match(line)
        if match and start is None:
            start, language = number + 1, match[1].strip()
            if note and language != "sh":
                faults.append((number, "a note on commands stands above a fence that is not ```sh"))
        elif match:
            found.append((language, start, lines[start - 1:number - 1], note))
            start = note = None
        elif start is None and line.strip():
            if note:
                faults.append((number, "a note on commands stands above no fence"))
            note = NOTE.match(line) and NOTE.match(line)[1]
            if not note and LIKE_NOTE.match(line):
                faults.append((number, f"not a note that is known: {line.strip()}"))
    if start is not None:
        faults.append((start - 1, "a fence without an end"))
    elif note:
        faults.append((len(lines), "a note on commands stands above no fence"))
    return found, faults


def anchors_of(path):
    """The names by which links reach the headings of a page."""
    found, in_fence = set(), False
    for line in path.read_text(encoding="utf-8").splitlines():
        in_fence ^= bool(FENCE.match(line))
        if not in_fence and HEADING.match(line):
            heading = re.sub(r"\]\([^)]*\)", "", HEADING.match(line)[1]).strip().lower()
            found.add(re.sub(r"[^\w -]", "", heading).replace(" ", "-"))
    return found


def fault_of_link(page, target, anchor):
    """What is wrong with a link in a page, or None."""
    path = page.parent / target if target else page
    if not path.exists():
        return f"no file {target}"
    if anchor and path.suffix == ".md" and anchor not in anchors_of(path):
        return f"no heading #{anchor} in {path.name}"
    return None


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
    try:
        done = subprocess.run([*program, "-c", command], cwd=folder, env=dict(os.environ, PATH=path), text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return None, f"not done after {SECONDS} s"
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
        for target, anchor in LINK.findall(re.sub(r"`[^`]*`", "", line)) if not in_fence else []:
            fault = None if "://" in target else fault_of_link(root / page, target, anchor)
            if fault:
                faults.append(f"{page}:{number}: {fault}")

    blocks, faults_of_notes = blocks_of(lines)
    faults += [f"{page}:{number}: {fault}" for number, fault in faults_of_notes]

    with tempfile.TemporaryDirectory() as scratch:
        pathlib.Path(scratch, "datasets").symlink_to(root / "datasets")
        for language, start, text, note in blocks:
            if language in OTHERS:
                continue
            if language not in ("sh", "python"):
                faults.append(f"{page}:{start - 1}: a fence of ```{language}, must be sh, python or one of "
                              f"{', '.join(sorted(OTHERS))}")
                continue
            kind, _, value = (note or "").partition(": ")
            if kind == "tested by":
                if not (root / value).is_file():
                    faults.append(f"{page}:{start}: tested by {value}, which does not exist")
                continue
            instead = kind == "tested as"
            expected = int(value or 1) if kind == "fails" else 0
            if instead:
                commands = [(start, value)]
            elif language == "python":
                commands = [(start, "\n".join(text))]
            else:
                commands = list(commands_of(start, text))
            if not commands:
                faults.append(f"{page}:{start}: a fence without a command")
            for number, command in commands:
                code, output = run(command, root if instead else scratch, path, "sh" if instead else language)
                if language == "python" and code != 0 and "ModuleNotFoundError" in output:
                    print(f"{page}:{number}: left out: {output.splitlines()[-1]}")
                    continue
                count += 1
                if code != expected:
                    faults.append(f"{page}:{number}: exit code {code}: {command}\n{output}")
    for fault in faults:
        print(fault)
    print(f"{page}: {count} commands")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
