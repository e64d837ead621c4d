"""For the tests of checkers, which plant faults in small projects."""
import pathlib
import subprocess
import sys
import tempfile


def run_checker(checker, tree, *arguments):
    """Exit code and lines of a checker.

    checker: the script, which takes the folder of a project and then `arguments`
    tree: text by path of each file of the project
    """
    with tempfile.TemporaryDirectory() as folder:
        for name, text in tree.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, checker, folder, *arguments], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines()
