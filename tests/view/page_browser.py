#!/usr/bin/env python3
"""Looks at the pages of page_sample in a headless Chromium: page_browser.py DIR [TEST...]"""
import math

from browser import pixels_of
from page_support import close, GREY, legend_of, map_colors, of_map, row_at, run_tests, side, untroubled, wait


def test_scalars(page, dir):
    page.open(dir / "plane.html")
    viridis = map_colors(page, "viridis")
    places = [-0.8, -0.4, 0.2, 0.8]
    for x, color in zip(places, page.color(*[row_at(x, 0.2) for x in places])):
        close(color, of_map(viridis, (x + 1) / 2))
    close(page.color(row_at(-0.8, -0.8))[0], GREY)  # no value
    page.set(map={"0": "magma"})
    close(page.color(row_at(0.4, 0.2))[0], of_map(map_colors(page, "magma"), 0.7))
    untroubled(page, dir / "plane.html")


def test_labels_colors_and_lines(page, dir):
    page.open(dir / "plane.html")
    page.set(field=2)
    labels = map_colors(page, "labels")
    quadrants = page.color(row_at(-0.5, -0.5), row_at(0.5, -0.5), row_at(-0.5, 0.5), row_at(0.5, 0.5))
    for label, color in enumerate(quadrants):
        close(color, labels[3 * label:3 * label + 3])
    page.set(field=3)
    close(page.color(row_at(0.5, 0))[0], [255, 0, 255])
    page.set(field=5)
    interval = 0.1
    on, off = page.color(row_at(0.6, 0), row_at(0.6 + interval / 2, 0))
    assert sum(on) < 0.75 * sum(off), f"an isoline at 0.6 has {on}, beside it {off}"
    assert "lines every 0.1 m" in page.run("return document.getElementById('legend').getAttribute('aria-label')")
    page.key("i", "KeyI")
    wait(page)
    assert sum(page.color(row_at(0.6, 0))[0]) > 0.85 * sum(off)


def test_mesh(page, dir):
    page.open(dir / "sphere.html")
    page.set(is_lit=False)
    page.key("3", "Digit3")
    wait(page)
    close(page.color(0)[0], of_map(map_colors(page, "coolwarm"), 1), 4)  # the pole faces the eye
    ring = 12 * 96  # a quarter of the way to the other pole
    height = math.cos(math.pi * 12 / 48)
    close(page.color(ring + 5)[0], of_map(map_colors(page, "coolwarm"), (1 + height) / 2), 4)
    x, y = page.run("return tufted.place(arguments[0])", ring + 5)[:2]
    assert page.run("return tufted.pick(arguments[0], arguments[1]).index", x, y) == ring + 5
    page.set(shown="both")
    assert page.run("return tufted.stage.points.visible && tufted.stage.triangles.visible")
    untroubled(page, dir / "sphere.html")


def test_vectors(page, dir):
    page.open(dir / "whirl.html")
    count = page.run("return tufted.stage.arrows.geometry.instanceCount")
    assert 300 < count <= 1500, count
    plain = page.run("return tufted.stage.uniforms.plain.value.toArray().map((c) => Math.round(255 * c))")
    colors = page.color(*range(0, side * side, 7))
    others = [color for color in colors if max(abs(a - b) for a, b in zip(color, plain)) > 20]
    assert len(others) > len(colors) / 20, "no arrow is seen"
    page.set(arrows=False)
    name = page.run("return JSON.parse(document.getElementById('scene').textContent).fields[0].map")
    close(page.color(row_at(0.6, 0.8))[0], of_map(map_colors(page, name), 1 / math.sqrt(2)))
    untroubled(page, dir / "whirl.html")


def test_numbers_of_any_size(page, dir):
    fields, rows = range(1, 5), range(0, side * side, 11)
    expected = {}
    for unit in ("1", "1e-50", "1e50", "1e120"):
        page.open(dir / f"unit-{unit}.html")
        for field in fields:
            page.set(field=field)
            colors = page.color(*rows)
            others = sum(max(abs(a - b) for a, b in zip(one, other)) > 6
                         for one, other in zip(colors, expected.setdefault(field, colors)))
            assert others <= 0.02 * len(rows), f"{others} of {len(rows)} points differ: unit {unit}, field {field}"
        untroubled(page, dir / f"unit-{unit}.html")


def test_numbers_that_differ_in_their_last_digits(page, dir):
    page.open(dir / "unit-1.html")
    viridis = map_colors(page, "viridis")
    places = [-0.8, -0.4, 0.2, 0.8]
    for x, color in zip(places, page.color(*[row_at(x, 0.2) for x in places])):
        close(color, of_map(viridis, (x + 1) / 2))
    assert "from 3.2e8 to 3.2000006e8 s" in legend_of(page), legend_of(page)
    x, y = page.run("return tufted.place(arguments[0])", row_at(0.2, 0.2))[:2]
    value = page.run("return tufted.pick(arguments[0], arguments[1]).value", x, y)
    assert value == "3.20000036e8 s", value
    page.set(lines={"0": True})
    assert "every 5 s" in legend_of(page), legend_of(page)
    # At 3.2e8 + 35 s there is a line, and between two lines none.
    on, off = page.color(row_at(1 / 6, 0), row_at(1 / 12, 0))
    assert sum(on) < 0.75 * sum(off), f"an isoline has {on}, beside it {off}"


def test_paths(page, dir):
    page.open(dir / "walk.html")
    red = page.run("return JSON.parse(document.getElementById('scene').textContent).pathColor")
    on, begin, beyond = page.color(row_at(-0.4, 0.2), row_at(-0.8, 0.2), row_at(0.4, 0.2))
    close(on, red)
    close(begin, [255, 255, 255])  # a ring
    close(beyond, of_map(map_colors(page, "viridis"), 0.7))  # the path has ended
    page.set(clip="x", clip_at=0.05)
    back = page.run("return tufted.stage.scene.background.toArray().map((c) => 255 * c)")
    close(page.color(row_at(-0.4, 0.2))[0], back)
    untroubled(page, dir / "walk.html")


def test_a_logarithmic_scale_and_names(page, dir):
    page.open(dir / "plane.html")
    assert "cut out" in legend_of(page), legend_of(page)
    page.set(field=6)
    viridis = map_colors(page, "viridis")
    places = [-0.8, -0.4, 0.2, 0.8]
    for x, color in zip(places, page.color(*[row_at(x, 0.2) for x in places])):
        close(color, of_map(viridis, (x + 1) / 2))
    assert "from 0.001 to 1000 m" in legend_of(page), legend_of(page)
    assert page.run("return document.getElementById('lines')") is None
    x, y = page.run("return tufted.place(arguments[0])", row_at(0.2, 0.2))[:2]
    value = page.run("return tufted.pick(arguments[0], arguments[1]).value", x, y)
    assert value == "3.981 m", value  # 10^0.6
    page.set(field=2)
    assert "south-west, south-east, 2, 3" in legend_of(page), legend_of(page)
    assert page.run("return tufted.pick(arguments[0], arguments[1]).value", x, y) == "3"
    page.set(field=-1)
    plain = page.run("return tufted.stage.uniforms.plain.value.toArray().map((c) => Math.round(255 * c))")
    close(page.color(row_at(0.2, 0.2))[0], plain)
    assert page.run("return document.getElementById('legend').hidden")


def test_a_depth_image_is_filled(page, dir):
    page.open(dir / "depth.html")
    width, height, pixel = pixels_of(page.screenshot())
    back = page.run("return tufted.stage.scene.background.toArray().map((c) => Math.round(255 * c))")
    is_back = lambda x, y: max(abs(a - b) for a, b in zip(pixel(x, y), back)) <= 2
    columns, rows = 160, 120
    labels = page.run("""
        const tint = tufted.stage.points.geometry.attributes.tint.array;
        return [...tufted.stage.positions.drawn].map((is_drawn, i) => is_drawn ? tint.subarray(4 * i, 4 * i + 3).join() : null);""")
    places = page.run("return Array.from({length: arguments[0]}, (_, row) => tufted.place(row).slice(0, 2))", columns * rows)
    holes, pairs = 0, 0
    for i, place in enumerate(places):
        for other in (i + 1, i + columns):
            if other >= len(places) or (other == i + 1 and other % columns == 0):
                continue
            if labels[i] is None or labels[i] != labels[other]:
                continue
            pairs += 1
            holes += is_back((place[0] + places[other][0]) / 2, (place[1] + places[other][1]) / 2)
    assert pairs > 15000 and holes == 0, f"{holes} holes between {pairs} pairs of pixels"
    # Nothing is drawn far from all points: no disc is a giant.
    reach = 12
    near = set()
    for label, (x, y) in zip(labels, places):
        if label is not None:
            near.update((int(x) // reach + i, int(y) // reach + j) for i in (-1, 0, 1) for j in (-1, 0, 1))
    right = page.run("return document.getElementById('canvas').clientWidth") - 10
    far = [(x, y) for x in range(10, right, 3) for y in range(60, height - 120, 3)
           if (x // reach, y // reach) not in near and not is_back(x, y)]
    assert not far, f"{len(far)} places far from all points are drawn, as {far[:3]}"


def test_directions_and_greys(page, dir):
    page.open(dir / "quarters.html")
    places = [row_at(-0.6, -0.6), row_at(0.6, -0.6), row_at(-0.6, 0.6), row_at(0.6, 0.6)]
    for color, expected in zip(page.color(*places), [[255, 128, 128], [128, 255, 128], [128, 128, 0], GREY]):
        close(color, expected)
    page.set(field=1)
    close(page.color(places[2])[0], [205, 205, 205])  # a negative label
    close(page.color(places[3])[0], GREY)
    assert "none" in legend_of(page) and "no value" in legend_of(page)
    page.set(field=2)
    source = page.color(row_at(0, 0))[0]
    assert source == [255, 255, 255], source  # the hole of the ring
    untroubled(page, dir / "quarters.html")


def test_a_thinned_cloud_keeps_its_numbers(page, dir):
    page.open(dir / "thinned.html")
    heading = page.run("return document.getElementById('heading').textContent")
    assert "of 10,201 points" in heading, heading
    picked = page.run("return tufted.pick(...tufted.place(1000).slice(0, 2))")
    assert picked["row"] == 1000 and picked["index"] > 4000, picked
    x, y, _ = picked["position"]
    assert picked["index"] == row_at(x, y), picked
    untroubled(page, dir / "thinned.html")


def test_empty(page, dir):
    page.open(dir / "empty.html")
    assert "No point" in page.run("return document.getElementById('message').textContent")
    untroubled(page, dir / "empty.html")


if __name__ == "__main__":
    run_tests(globals())
