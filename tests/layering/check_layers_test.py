#!/usr/bin/env python3
"""Plants one fault at a time in a small sound project and expects check_layers.py to name exactly that one."""
import pathlib
import sys
import tempfile

from check_layers import check

SOUND = {
    "include/tufted/types.h": "#include <Eigen/Core>\n#include <vector>\n",
    "include/tufted/laplacian.h": '#include "tufted/types.h"\n',
    "include/tufted/io/read.h": '#include "tufted/types.h"\n#include <filesystem>\n',
    "include/tufted/pcl/smooth.h": '#include <pcl/filters/filter.h>\n#include "tufted/laplacian.h"\n',
    "include/tufted/curve.h": "struct Curve {\n  int points;\n};\nstruct Other;\n",
    "src/base/scaling.h": "struct Scaling {\n  struct Curve {};\n};\nclass Other : public Scaling {\n};\n",
    "src/base/scaling.cpp": '#include "base/scaling.h"\n// printf("not code")\n',
    "src/neighbors/neighbors.cpp": '#include <flann/flann.hpp>\n#include "base/scaling.h"\n#include "tufted/types.h"\n',
    "src/cover/flips.cpp": 'const char* text = "std::cout";\n/* #include "stars/stars.h" */\n',
    "src/direct/star_rows.cpp": '#include "stars/stars.h"\n#include "cover/flips.h"\n',
    "src/operators/gradient.cpp": '#include "stars/frame.h"\nvoid f() { std::snprintf(a, 1, "x"); }\n',
    "src/io/read.cpp": '#include "io/errors.h"\n#include "tufted/io/read.h"\n#include <zip.h>\n',
    "src/pcl/smooth.cpp": '#include "tufted/pcl/smooth.h"\n',
    "src/python/files.cpp": '#include "python/module.h"\n#include "tufted/io/read.h"\n#include <pybind11/pybind11.h>\n',
    "tools/command/command.h": "#include <CLI/App.hpp>\n",
    "tools/command/tufted.cpp": '#include "command.h"\n#include "tufted/io/read.h"\nint main() { std::puts("ok"); }\n',
    "tools/bench/clouds.cpp": '#include "bench/costs.h"\n#include "stars/stars.h"\n',
    "tools/make_datasets.cpp": '#include "shapes/shapes.h"\n',
}

# file, line added to it, part of the fault that must be named
FAULTS = [
    ("src/base/scaling.h", "struct Curve {", "Curve is a type of include/tufted/curve.h, too"),
    ("src/base/scaling.cpp", '#include "neighbors/morton.h"', "base may not include neighbors"),
    ("src/neighbors/neighbors.cpp", '#include "cover/cover.h"', "neighbors may not include cover"),
    ("src/neighbors/neighbors.cpp", '  #  include "operators/gradient.h"', "neighbors may not include operators"),
    ("src/cover/flips.cpp", '#include "stars/stars.h"', "cover may not include stars"),
    ("src/cover/flips.cpp", '#include "simd/packet.h"', "cover may not include simd"),
    ("src/direct/star_rows.cpp", '#include "pipeline/result.h"', "direct may not include pipeline"),
    ("src/operators/gradient.cpp", '#include "algorithms/heat.h"', "operators may not include algorithms"),
    ("src/operators/gradient.cpp", '#include "pcl/smooth.h"', "operators may not include pcl"),
    ("src/operators/gradient.cpp", '#include "io/errors.h"', "operators may not include io/errors.h"),
    ("src/operators/gradient.cpp", '#include "tufted/io/read.h"', "operators may not include tufted/io"),
    ("src/operators/gradient.cpp", '#include "../tools/command.h"', "is in no room"),
    ("src/operators/gradient.cpp", "#include <iostream>", "<iostream>"),
    ("src/io/read.cpp", '#include "base/scaling.h"', "io may include public headers and its own only"),
    ("src/io/read.cpp", '#include "tufted/pcl/smooth.h"', "io may not include tufted/pcl"),
    ("src/python/files.cpp", '#include "base/scaling.h"', "python may not include base"),
    ("src/python/files.cpp", '#include "tufted/pcl/smooth.h"', "python may not include tufted/pcl"),
    ("src/extra/new.cpp", "int x;", "extra is no room"),
    ("include/tufted/laplacian.h", '#include "tufted/io/read.h"', "core headers may not include tufted/io"),
    ("include/tufted/laplacian.h", '#include "base/scaling.h"', "do not include base/scaling.h"),
    ("include/tufted/laplacian.h", "#include <CGAL/Point_3.h>", "do not include CGAL"),
    ("include/tufted/laplacian.h", "#include <flann/flann.hpp>", "do not include flann"),
    ("include/tufted/laplacian.h", "#include <omp.h>", "do not include omp.h"),
    ("include/tufted/laplacian.h", "#include <pcl/point_types.h>", "do not include pcl"),
    ("include/tufted/laplacian.h", "#include <iostream>", "<iostream>"),
    ("include/tufted/io/read.h", "#include <zip.h>", "do not include zip.h"),
    ("include/tufted/io/read.h", "#include <nlohmann/json.hpp>", "do not include nlohmann"),
    ("include/tufted/io/read.h", "#include <CLI/CLI.hpp>", "do not include CLI"),
    ("include/tufted/io/read.h", '#include "tufted/pcl/smooth.h"', "io headers may not include tufted/pcl"),
    ("include/tufted/pcl/smooth.h", "#include <CGAL/Point_3.h>", "do not include CGAL"),
    ("tools/command/tufted.cpp", '#include "stars/stars.h"', "tools may include public headers only"),
    ("src/neighbors/neighbors.cpp", "void f() { std::cerr << 1; }", "std::cerr"),
    ("src/neighbors/neighbors.cpp", 'void f() { printf("x"); }', "printf"),
    ("src/io/read.cpp", 'void f() { std::fputs("x", file); }', "fputs"),
    ("src/base/scaling.cpp", "void f() { std::fwrite(a, 1, 1, stderr); }", "stderr"),
]


def run(tree):
    """The faults of a project of these files: text by path."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in tree.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return check(pathlib.Path(folder).resolve())


problems = []
if run(SOUND):
    problems.append(f"the sound project is refused: {run(SOUND)}")
if not run({}):
    problems.append("an empty project passes")
for file, line, expected in FAULTS:
    lines = run({**SOUND, file: SOUND.get(file, "") + line + "\n"})
    if len(lines) != 1 or file not in lines[0] or expected not in lines[0]:
        problems.append(f"{file} with {line!r}: expected one fault with {expected!r}, got {lines}")
print("\n".join(problems) if problems else f"{len(FAULTS)} planted faults found")
sys.exit(1 if problems else 0)
