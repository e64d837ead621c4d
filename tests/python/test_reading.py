"""Files that are bad, or that hold more than is read."""
import numpy as np
import pytest

import tufted
from support import DATASETS, sphere


def test_files_that_are_bad_are_named(tmp_path):
    with pytest.raises(tufted.IoError, match="nowhere.ply"):
        tufted.read(tmp_path / "nowhere.ply")
    (tmp_path / "bad.ply").write_text("ply\nformat ascii 1.0\nelement vertex x\n")
    with pytest.raises(OSError, match="bad.ply: line 3"):
        tufted.read(tmp_path / "bad.ply")
    with pytest.raises(tufted.IoError):
        tufted.load(tmp_path)
    with pytest.raises(tufted.IoError):
        tufted.PointCloud(sphere(50)).save("/proc/nowhere")
    with pytest.raises(tufted.IoError):
        tufted.read(DATASETS / "sphere_uniform.ply", kind="mesh")
    assert isinstance(tufted.read(DATASETS / "fins.obj", kind="cloud"), tufted.PointCloud)
    with pytest.raises(tufted.InvalidInput, match="kind = 'volume', must be one of"):
        tufted.read(DATASETS / "fins.obj", kind="volume")


def test_what_a_file_holds_but_is_not_read_is_a_warning(tmp_path):
    file = tmp_path / "a.xyz"
    np.savetxt(file, sphere(100), header="100", comments="")
    with open(file, "a", encoding="ascii") as text:
        text.write("7 8 9\n")
    for read in (tufted.read, tufted.read_point_cloud):
        with pytest.warns(UserWarning, match="a.xyz: line 102: 6 bytes behind the last record") as caught:
            assert len(read(file)) == 100
        assert caught[0].filename == __file__


def test_names_of_fields_are_known_as_programs_write_them(tmp_path):
    points = sphere(100)
    file = tmp_path / "a.csv"
    np.savetxt(file, np.column_stack([np.arange(100), points]), delimiter=",", header='"","X","Y","Z"', comments="")
    np.testing.assert_array_equal(tufted.read(file).points, points)
