"""Kills the command `tufted` at random moments while it writes results, and looks at what is left.

Usage: kill_command.py COMMAND FILE [TIMES]

After each kill the result folder must hold the earlier result, the new one, or none that is taken for a result:
report.json is missing then, and .tufted-*/old has what was replaced. Runs that end must be whole. In the end a run
into the same folder must work.
"""

import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time


def state_of(folder, wholes):
    """"none", "whole", or "between": without report.json. Anything else is a fault."""
    if not folder.exists():
        return "none"
    names = {path.name: path for path in folder.iterdir() if not path.name.startswith(".")}
    if not names:
        return "none"
    if "report.json" not in names:
        assert any((hidden / "old").is_dir() for hidden in folder.glob(".tufted-*")), "files without report.json and old/"
        return "between"
    files = json.loads(names["report.json"].read_text())["files"]
    content = {name: names[name].read_bytes() for name in files if name != "report.json"}
    assert content in wholes, "a result of which not all files belong together"
    return "whole"


def content_of(folder):
    files = json.loads((folder / "report.json").read_text())["files"]
    return {name: (folder / name).read_bytes() for name in files if name != "report.json"}


def main():
    command, source = sys.argv[1:3]
    times = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    chance = random.Random(101)
    root = pathlib.Path(tempfile.mkdtemp())
    calls = [["laplacian", source, "--preset", preset, "--quiet"] for preset in ("clean", "scan")]
    wholes, longest = [], 0
    for i, call in enumerate(calls):
        begin = time.monotonic()
        subprocess.run([command, *call, "--out", root / str(i)], check=True)
        longest = max(longest, time.monotonic() - begin)
        wholes.append(content_of(root / str(i)))
    counts = {}
    for i in range(times):
        folder = root / ("new%d" % i if i % 2 else "again")
        process = subprocess.Popen([command, *calls[chance.randrange(2)], "--out", folder], stderr=subprocess.PIPE)
        time.sleep(chance.random() * 1.1 * longest)
        sent = chance.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        process.send_signal(sent)
        message = process.communicate()[1].decode(errors="replace")
        key = (sent.name, process.returncode, state_of(folder, wholes), bool(list(root.glob("**/.tufted-*"))))
        counts[key] = counts.get(key, 0) + 1
        assert process.returncode != -signal.SIGSEGV and "terminate" not in message, message
        if sent != signal.SIGKILL:
            for hidden in folder.glob(".tufted-*"):
                assert i % 2 == 0, "a hidden folder is left behind after %s" % sent.name
        if i % 2:
            shutil.rmtree(folder, ignore_errors=True)
    for key, count in sorted(counts.items(), key=str):
        print("%s, exit code %d, %s, hidden folder anywhere %s: %d" % (*key, count))
    subprocess.run([command, *calls[0], "--out", root / "again"], check=True)
    assert content_of(root / "again") == wholes[0]
    print("left in the folder: %d hidden folders" % len(list((root / "again").glob(".tufted-*"))))
    shutil.rmtree(root)


if __name__ == "__main__":
    main()
