#!/usr/bin/env python3
"""The size of a page of random points with one field, and the time from the start of the navigation to the first picture
in a headless Chromium that draws without a graphics card: page_speed.py PAGE_SAMPLE [N...]"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

from browser import browser

runs = 5
sample, counts = sys.argv[1], [int(n) for n in sys.argv[2:]] or [100_000, 1_000_000]
print("points     megabytes  seconds to the first picture (median, least, greatest)")
with tempfile.TemporaryDirectory() as folder, browser() as page:
    page.resize(1280, 800)
    for n in counts:
        subprocess.run([sample, folder, str(n)], check=True)
        path = pathlib.Path(folder) / f"{n}.html"
        times = []
        for _ in range(runs):
            page.open(path)
            times.append(page.run("return tufted.first_picture") / 1000)
        print(f"{n:<10} {path.stat().st_size / 1e6:<10.2f} {statistics.median(times):.2f}, {min(times):.2f}, {max(times):.2f}")
