"""Clouds that are larger than memory."""
import json
import os
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._clouds import selection_of
from ._results import TuftedWarning
from ._tufted import InvalidInput


@check.public
def laplacian_by_tiles(source, out, *, memory=4e9, preset="clean", keep_noise=False, neighbors=30, mollify=1e-6,
                       where=(), crop=None, polygon=None, thin=0, threads=0, progress=None):
    """Builds L and M of a cloud that is larger than memory, as `tufted laplacian --memory` does, and writes them into
    the directory `out`: L_data.npy, L_indices.npy and L_indptr.npy for scipy.sparse.csr_matrix, M.npy and others, all
    of which np.load(..., mmap_mode="r") opens without reading them.

    source: a file, of which LAS, NPY, and binary PLY and PCD are read in passes; or N x 3 points.
    memory: bytes that the build may take; points as an array come on top.
    preset: as in PointCloud; those other than "clean" need keep_noise=True, as tiles do not move noisy points.
    neighbors, mollify: as in PointCloud. where, crop, polygon, thin: as in read(), for files.
    threads: at most this many; 0: one per processor. progress: called with stage and fraction, see Surface.
    Returns a dict, the member "report" of out/report.json. Raises IoError if a file cannot be read or written.
    """
    name = "laplacian_by_tiles"
    preset, keep_noise = check.text(name, "preset", preset), check.flag(name, "keep_noise", keep_noise)
    if preset in ("scan", "lidar") and not keep_noise:
        raise InvalidInput(f"{name}: preset = {preset!r}, must be 'clean' unless keep_noise is True")
    is_file = isinstance(source, (str, os.PathLike))
    selection = selection_of(where, crop, polygon, thin)
    chosen = {"where": [where] if isinstance(where, str) else list(where), "thin": float(thin) if thin else 0,
              "crop": [] if crop is None else np.ravel(crop).tolist(),
              "polygon": [] if polygon is None else np.asarray(polygon).tolist()}
    chosen = {key: value for key, value in chosen.items() if value}
    if chosen and not is_file:
        raise InvalidInput(f"{name}: where, crop, polygon or thin is given, must not be for points")
    source = check.path(name, "source", source) if is_file else check.rows_of_three(name, "source", source)
    out = check.path(name, "out", out)
    sentences = _tufted.write_by_tiles(
        out, source, selection, json.dumps(chosen) if chosen else "", preset, keep_noise,
        check.number(name, "memory", memory), check.whole(name, "neighbors", neighbors, 0),
        check.number(name, "mollify", mollify), check.whole(name, "threads", threads, 0),
        check.callback(name, progress))
    for sentence in sentences:
        warnings.warn(f"{name}: {sentence}", TuftedWarning, stacklevel=3)
    with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
        return json.load(file)["report"]
