#!/usr/bin/env python3
"""Looks at the pages of page_sample in a headless Chromium: page_browser.py DIR"""
import math
import pathlib
import sys

from browser import browser

side = 101  # points along the sides of the squares
GREY = [150, 150, 150]


def row_at(x, y):
    """The point of a square nearest to (x, y), both from -1 to 1."""
    return round((y + 1) / 2 * (side - 1)) * side + round((x + 1) / 2 * (side - 1))


def close(color, expected, tolerance=3):
    assert all(abs(a - b) <= tolerance for a, b in zip(color, expected)), f"{color}, must be near {expected}"


def map_colors(page, name):
    return page.run("const s = JSON.parse(document.getElementById('scene').textContent);"
                    "return [...atob(s.maps.find((m) => m.name === arguments[0]).colors)].map((c) => c.charCodeAt(0))", name)


def of_map(colors, t):
    i = round(t * 255)
    return colors[3 * i:3 * i + 3]


def untroubled(page, path):
    assert page.requests() == [path.resolve().as_uri()], "a request leaves the page"
    errors = page.errors()
    assert not errors, errors


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


def test_columns_and_keys(page, dir):
    page.open(dir / "plane.html")
    page.set(field=1)
    coolwarm = map_colors(page, "coolwarm")
    row = row_at(0.1, 0.1)
    for column, t in enumerate([0, 0.5, 0.75, 1]):
        page.run("const s = document.getElementById('column'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))",
                 column + 1)
        page.run("return new Promise((done) => setTimeout(done, 100))")
        close(page.color(row)[0], of_map(coolwarm, t), 4)
    page.key(",", "Comma")
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert page.run("return tufted.state.column") == 2
    page.run("document.getElementById('column').focus()")
    page.key("ArrowLeft", "ArrowLeft", windowsVirtualKeyCode=37)
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert page.run("return tufted.state.column") == 1
    page.key("]", "BracketRight")
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert page.run("return tufted.state.field") == 2


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
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert sum(page.color(row_at(0.6, 0))[0]) > 0.85 * sum(off)


def test_picking(page, dir):
    page.open(dir / "plane.html")
    row = row_at(0.5, -0.24)
    x, y = page.run("return tufted.place(arguments[0])", row)[:2]
    picked = page.run("return tufted.pick(arguments[0], arguments[1])", x, y)
    assert picked["index"] == row, picked
    assert math.dist(picked["position"], [0.5, -0.24, 0]) < 2e-5 and abs(picked["number"] - 0.5) < 2e-5, picked
    page.mouse("mouseMoved", x, y)
    page.run("return new Promise((done) => setTimeout(done, 100))")
    tip = page.run("return document.getElementById('tip').innerText")
    assert "0.5" in tip and "−0.24" in tip and f"{row:,}" in tip, tip
    page.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    page.mouse("mouseReleased", x, y, button="left", clickCount=1)
    assert page.run("return tufted.pinned") == row
    page.run("tufted.stage.resize()")
    page.key("Escape", "Escape")
    assert page.run("return tufted.pinned") is None


def test_turning_and_cutting(page, dir):
    page.open(dir / "plane.html")
    before = page.run("return tufted.stage.camera.position.toArray()")
    page.mouse("mousePressed", 300, 300, button="left", buttons=1, clickCount=1)
    page.mouse("mouseMoved", 360, 330, button="left", buttons=1)
    page.mouse("mouseReleased", 360, 330, button="left", clickCount=1)
    turned = page.run("return tufted.stage.camera.position.toArray()")
    assert math.dist(before, turned) > 0.1
    assert abs(math.hypot(*before) - math.hypot(*turned)) < 1e-6
    page.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=-200)
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert page.run("return tufted.stage.controls.distance") < 0.9 * math.hypot(*before)
    page.run("document.getElementById('canvas').focus()")
    page.key("f", "KeyF")
    assert math.dist(before, page.run("return tufted.stage.camera.position.toArray()")) < 1e-6
    inside = page.color(row_at(0.6, 0.2))[0]
    page.set(clip="x", clip_at=0.5)
    back = page.run("return tufted.stage.scene.background.toArray().map((c) => 255 * c)")
    close(page.color(row_at(0.6, 0.2))[0], back)
    assert page.run("return tufted.pick(...tufted.place(arguments[0]).slice(0, 2))", row_at(0.6, 0.2)) is None
    page.set(is_flipped=True)
    close(page.color(row_at(0.6, 0.2))[0], inside)


def test_mesh(page, dir):
    page.open(dir / "sphere.html")
    page.set(is_lit=False)
    page.key("3", "Digit3")
    page.run("return new Promise((done) => setTimeout(done, 100))")
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


def test_touch_on_a_phone(page, dir):
    page.resize(390, 844, mobile=True, scale=2)
    page.open(dir / "plane.html")
    assert page.run("return document.documentElement.scrollWidth") == 390
    row = row_at(0.4, 0.4)
    x, y = page.run("return tufted.place(arguments[0])", row)[:2]
    page.touch("touchStart", [(x, y)])
    page.touch("touchEnd", [])
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert page.run("return tufted.pinned") == row
    before = page.run("return tufted.stage.controls.distance")
    page.touch("touchStart", [(150, 400), (240, 400)])
    for step in range(1, 6):
        page.touch("touchMove", [(150 - 10 * step, 400), (240 + 10 * step, 400)])
    page.touch("touchEnd", [])
    assert page.run("return tufted.stage.controls.distance") < 0.7 * before
    page.touch("touchStart", [(200, 300)])
    for step in range(1, 6):
        page.touch("touchMove", [(200 + 10 * step, 300)])
    page.touch("touchEnd", [])
    assert abs(page.run("return tufted.stage.camera.position.x")) > 0.05
    is_folded = "return document.getElementById('panel').classList.contains('folded')"
    assert page.run(is_folded)
    page.run("document.getElementById('fold').click()")
    assert not page.run(is_folded)
    page.resize(1280, 800)


def test_dark_page(page, dir):
    page.prefer("dark")
    page.open(dir / "plane.html")
    dark = page.run("return tufted.stage.scene.background.toArray()")
    assert max(dark) < 0.2, dark
    page.run("document.getElementById('theme').click()")
    assert min(page.run("return tufted.stage.scene.background.toArray()")) > 0.9
    page.prefer("light")


def test_hostile_names(page, dir):
    page.open(dir / "hostile.html")
    assert page.run("return window.harm") is None
    assert "<img src=x" in page.run("return document.querySelector('h1').textContent")
    assert page.run("return document.querySelectorAll('img, svg, b').length") == 0
    for field in (1, 0):
        page.set(field=field)
    x, y = page.run("return tufted.place(arguments[0])", row_at(0.5, 0.5))[:2]
    page.mouse("mouseMoved", x, y)
    page.run("return new Promise((done) => setTimeout(done, 100))")
    assert "</script>" in page.run("return document.getElementById('tip').textContent")
    assert page.run("return window.harm") is None
    untroubled(page, dir / "hostile.html")


def test_empty(page, dir):
    page.open(dir / "empty.html")
    assert "No point" in page.run("return document.getElementById('message').textContent")
    untroubled(page, dir / "empty.html")


if __name__ == "__main__":
    pages = pathlib.Path(sys.argv[1])
    only = sys.argv[2:]
    failed = 0
    with browser() as page:
        for name, test in list(globals().items()):
            if not name.startswith("test_") or (only and name not in only):
                continue
            page.resize(1280, 800)
            page.prefer("light")
            try:
                test(page, pages)
                print(f"{name}: ok", flush=True)
            except Exception as error:  # the next tests say more
                failed += 1
                print(f"{name}: FAILED: {type(error).__name__}: {error}", flush=True)
    sys.exit(1 if failed else 0)
