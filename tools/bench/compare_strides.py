#!/usr/bin/env python3
"""compare_strides.py FILE WIDTH HEIGHT: heat kernel signatures of every pixel of a depth image beside those of every second
and third row and column, and the time of curvature. Prints the rows of the table in docs/speed.md. Needs the package
tufted, and numpy."""
import sys
import time

import numpy as np
import tufted

PAIRS = 64


def main():
    width, height = int(sys.argv[2]), int(sys.argv[3])
    image = tufted.read(sys.argv[1], image=False, preset="clean").points.reshape(height, width, 3)
    times = of_all = None
    for stride in 1, 2, 3:
        pixels = image[: height // stride * stride : stride, : width // stride * stride : stride]
        rows, columns = pixels.shape[:2]
        cloud = tufted.PointCloud(pixels.reshape(-1, 3), image=(columns, rows), threads=1)
        start = time.process_time()
        values, vectors = cloud.spectrum(PAIRS + 1)
        values = values[values > 0]
        if stride == 1:
            times = np.geomspace(4 * np.log(10) / values[-1], 4 * np.log(10) / values[0], 16)
        signature = cloud.hks(times, k=PAIRS).reshape(rows, columns, -1)
        seconds = time.process_time() - start
        taking_part = np.asarray(cloud.M).reshape(rows, columns) > 0
        start = time.process_time()
        cloud.curvature()
        row = f"{stride}: {taking_part.sum()} points, {seconds:.1f} CPU s"
        row += f", curvature {time.process_time() - start:.2f} CPU s"
        if stride == 1:
            of_all, all_values, all_parts = signature, values, taking_part
        else:
            both = taking_part & all_parts[::stride, ::stride][:rows, :columns]
            error = np.abs(signature[both] / of_all[::stride, ::stride][:rows, :columns][both] - 1)
            change = np.abs(values / all_values - 1)
            row += f", eigenvalues {change.mean():.1%}, at most {change.max():.1%}"
            row += f", signatures: median at most {np.median(error, axis=0).max():.1%}"
            row += f", 95 % at most {np.quantile(error, 0.95, axis=0).max():.1%}"
        print(row, flush=True)


if __name__ == "__main__":
    main()
