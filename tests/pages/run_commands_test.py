#!/usr/bin/env python3
"""Plants one fault at a time in a small sound page and expects run_commands.py to name exactly that one."""
import pathlib
import subprocess
import sys
import tempfile

RUNNER = pathlib.Path(__file__).with_name("run_commands.py")

SOUND = """# Page
See [another](other.md#the-second-part), [below](#page), [the web](https://example.com) and `[no](link)`.

```sh
ls datasets/sphere.ply    # a comment
mkdir -p out && \\
  echo 1 > out/one
test -s out/one
```

<!-- tested as: test -e datasets/sphere.ply && test ! -e out -->
```sh
sleep 1000
```

<!-- tested by: datasets/sphere.ply -->
```sh
sleep 1001
```

<!-- fails -->
```sh
test -e out/two
```

<!-- fails: 3 -->
```sh
exit 3
```

```python
with open("out/one", encoding="utf-8") as file:
    assert file.read() == "1\\n"
```

```cpp
int main() {}
```
"""

# text of the page, what it becomes, part of the fault that must be named
FAULTS = [
    ("ls datasets/sphere.ply", "ls datasets/spere.ply", "page.md:5: exit code 2: ls datasets/spere.ply"),
    ("echo 1 > out/one", "echo 1 | false", "page.md:6: exit code 1: mkdir -p out &&"),
    ("test -s out/one", "tuffted sphere", "page.md:8: exit code 127"),
    ("test -s out/one", "tufted cpoy", "page.md:8: exit code 2: tufted cpoy\nunknown command cpoy"),
    ("test ! -e out", "test -e out", "page.md:13: exit code 1: test -e datasets/sphere.ply"),
    ("tested by: datasets/sphere.ply", "tested by: tests/none.py", "page.md:18: tested by tests/none.py, which"),
    ("test -e out/two", "test -e out/one", "page.md:23: exit code 0"),
    ("test -e out/two", "exit 2", "page.md:23: exit code 2"),
    ("exit 3", "exit 1", "page.md:28: exit code 1"),
    ("exit 3", "# exit 3", "page.md:28: a fence without a command"),
    ('== "1', '== "2', "page.md:32: exit code 1: with open"),
    ("<!-- fails -->", "<!-- failing -->", "page.md:21: not a note that is known: <!-- failing -->"),
    ("<!-- fails: 3 -->", "<!-- fails: 3 -->\ntext", "page.md:27: a note on commands stands above no fence"),
    ("```cpp", "<!-- fails -->\n```cpp", "page.md:37: a note on commands stands above a fence that is not ```sh"),
    ("int main() {}\n```", "int main() {}\n```\n<!-- fails -->", "page.md:39: a note on commands stands above no"),
    ("int main() {}\n```", "int main() {}", "page.md:36: a fence without an end"),
    ("```sh\nls", "```bash\nls", "page.md:4: a fence of ```bash"),
    ("```sh\nls", "```\nls", "page.md:4: a fence of ```, must be"),
    ("See [", "    tufted info FILE\n\nSee [", "page.md:2: a command outside of a ```sh fence"),
    ("other.md#the-second-part", "others.md", "page.md:2: no file others.md"),
    ("#the-second-part", "#the-third-part", "page.md:2: no heading #the-third-part in other.md"),
    ("(#page)", "(#pages)", "page.md:2: no heading #pages in page.md"),
]


def run(page):
    """Exit code and output of the runner on this page."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "datasets").mkdir()
        (root / "datasets/sphere.ply").write_text("ply\n", encoding="utf-8")
        (root / "other.md").write_text("# Other\n## The *second* part\n", encoding="utf-8")
        (root / "bin").mkdir()
        (root / "bin/tufted").write_text("#!/bin/sh\necho unknown command $1\nexit 2\n", encoding="utf-8")
        (root / "bin/tufted").chmod(0o755)
        (root / "page.md").write_text(page, encoding="utf-8")
        done = subprocess.run([sys.executable, RUNNER, folder, "page.md", root / "bin"], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stdout


problems = []
code, output = run(SOUND)
if code != 0 or not output.endswith("page.md: 7 commands\n"):
    problems.append(f"the sound page is refused: {output}")
for text, becomes, expected in FAULTS:
    assert SOUND.count(text) == 1, text
    code, output = run(SOUND.replace(text, becomes))
    if code == 0 or expected not in output:
        problems.append(f"{becomes!r}: expected {expected!r}, got {output!r}")
for problem in problems:
    print(problem)
sys.exit(1 if problems else 0)
