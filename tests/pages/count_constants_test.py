#!/usr/bin/env python3
"""What tools/bench/count_constants.py takes for a constant of C++."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"))
from count_constants import constants_of  # noqa: E402

CODE = """constexpr double farthest = 1e70;  // spreads
constexpr int bits = 16, few = 1 << bits;
  static constexpr std::array<int, 2> few_neighbors = {8, 13};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// constexpr int gone = 3;
constexpr int table[] = {1, 2, 3, 4, 5};
if constexpr (is_wide) f(7);
"""
EXPECTED = [("farthest", "1e70"), ("bits", "16"), ("few", "1 << bits"), ("few_neighbors", "{8, 13}")]

found = constants_of(CODE)
if found != EXPECTED:
    sys.exit(f"expected {EXPECTED}, found {found}")
