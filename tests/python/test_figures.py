"""Pictures and pages of surfaces."""
import re
import zlib

import numpy as np
import pytest

import tufted
from support import CLOUD


def pixels(png):
    """Height x width x channels of a PNG file with 8 bits, as the library writes it."""
    width, height = (int.from_bytes(png[at:at + 4], "big") for at in (16, 20))
    channels = {2: 3, 6: 4}[png[25]]
    packed, at = b"", 8
    while at < len(png):
        length, name = int.from_bytes(png[at:at + 4], "big"), png[at + 4:at + 8]
        packed += png[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels)
    image = np.zeros((height, width * channels), int)
    for y, (kind, *row) in enumerate(rows.tolist()):  # undoes the filter of each row
        above = image[y - 1] if y else np.zeros(width * channels, int)
        for x, value in enumerate(row):
            left, corner = (image[y, x - channels], above[x - channels]) if x >= channels else (0, 0)
            guess = left + above[x] - corner
            paeth = min((left, above[x], corner), key=lambda near: abs(guess - near))
            image[y, x] = (value + (0, left, above[x], (left + above[x]) // 2, paeth)[kind]) % 256
    return image.reshape(height, width, channels)


def test_a_picture_has_the_colours_of_its_values(mesh, tmp_path):
    """Without light and legend, left and right of the middle are the ends of the colour map."""
    x = mesh.points[:, 0]
    found = mesh.picture(x, camera="top", size=(120, 90), light=False, legend=False, color_map="coolwarm")
    image = pixels(found.png)
    assert image.shape == (90, 120, 3) and repr(found).startswith("<tufted.Picture: 120 x 90 pixels")
    inside = (image != 255).any(axis=2)
    left, right = np.argwhere(inside)[:, 1].min(), np.argwhere(inside)[:, 1].max()
    blue, red = image[45, left + 3], image[45, right - 3]
    assert blue[2] > blue[0] + 60 and red[0] > red[2] + 60
    found.save(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").read_bytes() == found.png == found._repr_png_()


def test_cameras_look_from_where_they_are_told(mesh):
    """A torus seen from above has a hole, from the side it has none; twice the zoom covers more."""
    top, side, near = (pixels(mesh.picture(camera=camera, up="z", size=(64, 48), legend=False).png)
                       for camera in ("top", (20, 0), (20, 0, 2)))
    covered = [(image != 255).any(axis=2) for image in (top, side, near)]
    assert not covered[0][24, 32] and covered[1][24, 32]
    assert covered[2].sum() > 2 * covered[1].sum()


def test_lines_isolines_and_backgrounds_change_the_picture(mesh):
    x = mesh.points[:, 0]
    plain = mesh.picture(x, size=(320, 240)).png
    for change in ({"line": mesh.path(0, 900)}, {"line": mesh.trace(0, [0, 1, 0], 1).points}, {"isolines": True},
                   {"background": "dark"}, {"range": (-5, 5)}, {"light": False}, {"legend": False}, {"title": "x"},
                   {"color_map": "magma"}, {"kind": "diverging"}):
        assert mesh.picture(x, size=(320, 240), **change).png != plain, change
    assert mesh.picture(x, size=(320, 240)).png == plain
    assert pixels(mesh.picture(x, background="transparent", size=(320, 240), legend=False).png)[0, 0, 3] == 0


def test_values_of_every_kind_are_drawn(cloud):
    vectors = cloud.frames[:, 0]
    for kind, values in (("vector", vectors), ("direction", vectors), ("color", 255 * abs(vectors)),
                         ("coordinates", vectors[:, :2]), ("label", cloud.components), ("positive", cloud.M),
                         ("distance", cloud.distance(0)), ("diverging", CLOUD[:, 0]), ("scalar", CLOUD)):
        assert cloud.picture(values, kind=kind, size=(64, 48)).png[1:4] == b"PNG"
    same = [cloud.picture(vectors, kind=kind, size=(64, 48)).png for kind in (None, "vector")]
    assert same[0] == same[1]
    parts = cloud.segments(3).labels
    assert cloud.picture(parts, size=(64, 48)).png == cloud.picture(parts, kind="label", size=(64, 48)).png


def test_the_first_column_that_varies_is_shown(cloud):
    vectors = cloud.spectrum(4).vectors
    assert cloud.picture(vectors, size=(64, 48)).png == cloud.picture(vectors, column=1, size=(64, 48)).png
    assert cloud.picture(vectors, size=(64, 48)).png != cloud.picture(vectors, column=2, size=(64, 48)).png
    gaps = np.where(np.arange(3000) % 2, np.nan, 1.0)
    assert cloud.picture(gaps, size=(64, 48)).png  # nothing varies


def test_a_page_holds_all_fields(cloud, tmp_path):
    page = cloud.page({"height": CLOUD[:, 2], "from <the> first": cloud.distance(0)}, tmp_path / "page.html",
                      kind={"from <the> first": "distance"}, line=cloud.path(0, 5), camera=(10, 20), title="a & b")
    assert page.startswith("<!") and repr(page) == f"<tufted.Page: {len(page):,} characters>"
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page
    assert "height" in page and "distance" in page and "<script src" not in page
    frame = page._repr_html_()
    assert frame.startswith("<iframe") and len(re.findall("<", frame)) == 2
    assert "area of a point" in cloud.page()


@pytest.mark.parametrize("given, words", [
    ({"kind": "heat"}, "picture: kind = 'heat', must be one of"),
    ({"size": 300}, "picture: size = 300, must be (width, height)"),
    ({"size": (9, 9)}, "picture: width 9, must be from 16 to 8192"),
    ({"camera": "left"}, "picture: camera = 'left', must be 'top' or angles"),
    ({"camera": (1, 2, 3, 4)}, "picture: camera = (1, 2, 3, 4), must be (azimuth, elevation)"),
    ({"up": "up"}, "picture: up = 'up', must be one of 'x'"),
    ({"column": 3}, "picture: column 3 of field values"),
    ({"color_map": "jet"}, "picture: color map jet, must be one of viridis"),
    ({"background": "red"}, "picture: background = 'red', must be one of"),
    ({"line": [1, 2]}, "picture: line has the shape 2, must be N x 3"),
    ({"range": 3}, "picture: range has the shape (), must be 2"),
    ({"range": [[0, 1], [2, 3]]}, "picture: range has the shape 2 x 2, must be 2"),
    ({"kind": {"height": "label"}}, "picture: kind has the name 'height', must be one of values"),
    ({"kind": {"values": "label"}, "values": None}, "picture: kind has the name 'values', must be one of values"),
    ({"kind": 3}, "picture: kind is a int, must be a text"),
    ({"color_map": 3}, "picture: color_map is a int, must be a text"),
    ({"background": None}, "picture: background is a NoneType, must be a text"),
    ({"values": [1, 2]}, "picture: values has the shape 2, must be 3000"),
    ({"values": {"a": "b"}}, "picture: values has dtype"),
])
def test_mistakes_are_named(cloud, given, words):
    with pytest.raises(tufted.InvalidInput) as caught:
        cloud.picture(**{"values": CLOUD[:, 0], **given})
    assert words in str(caught.value)


def test_a_file_that_cannot_be_written_is_named(cloud, tmp_path):
    path = tmp_path / "missing" / "file"
    for call in (lambda: cloud.page(path=path), lambda: cloud.picture(size=(32, 32)).save(str(path))):
        with pytest.raises(tufted.IoError, match="missing/file: cannot write: No such file"):
            call()


def test_odd_surfaces_are_drawn():
    for points in (np.zeros((0, 3)), [[0, 0, 0]], np.full((5, 3), np.nan), np.zeros((9, 3))):
        with pytest.warns(tufted.TuftedWarning):
            surface = tufted.PointCloud(points)
        assert surface.picture(np.zeros(len(surface)), size=(32, 32)).png and surface.page() and surface.picture().png
