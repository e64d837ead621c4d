#!/usr/bin/env python3
"""Looks at the pages of page_sample in a headless Chromium: page_browser.py DIR"""
import math
import pathlib
import sys
import tempfile
import time

from browser import browser, pixels_of

side = 101  # points along the sides of the squares
SIZE = [800, 600]  # of the window, in pixels; small, as a processor draws them
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


def legend_of(page):
    return page.run("return document.getElementById('legend').getAttribute('aria-label')")


def wait(page):
    """Until what has happened on the page is drawn: two frames, as the first may have begun before."""
    page.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


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
    page.set(field=1, range="all")
    coolwarm = map_colors(page, "coolwarm")
    row = row_at(0.1, 0.1)
    for column, t in enumerate([0, 0.5, 0.75, 1]):
        page.run("const s = document.getElementById('column'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))",
                 column + 1)
        wait(page)
        close(page.color(row)[0], of_map(coolwarm, t), 4)
    page.key(",", "Comma")
    wait(page)
    assert page.run("return tufted.state.column") == 2
    page.run("document.getElementById('column').focus()")
    page.key("ArrowLeft", "ArrowLeft", windowsVirtualKeyCode=37)
    wait(page)
    assert page.run("return tufted.state.column") == 1
    page.key("]", "BracketRight")
    wait(page)
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
    wait(page)
    assert sum(page.color(row_at(0.6, 0))[0]) > 0.85 * sum(off)


def test_picking(page, dir):
    page.open(dir / "plane.html")
    row = row_at(0.5, -0.24)
    x, y = page.run("return tufted.place(arguments[0])", row)[:2]
    picked = page.run("return tufted.pick(arguments[0], arguments[1])", x, y)
    assert picked["index"] == row, picked
    assert math.dist(picked["position"], [0.5, -0.24, 0]) < 2e-5 and abs(picked["number"] - 0.5) < 2e-5, picked
    page.mouse("mouseMoved", x, y)
    wait(page)
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
    wait(page)
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


def test_touch_on_a_phone(page, dir):
    page.resize(390, 844, mobile=True, scale=2)
    page.open(dir / "plane.html")
    assert page.run("return document.documentElement.scrollWidth") == 390
    row = row_at(0.4, 0.4)
    x, y = page.run("return tufted.place(arguments[0])", row)[:2]
    page.touch("touchStart", [(x, y)])
    page.touch("touchEnd", [])
    wait(page)
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
    page.resize(*SIZE)


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


def test_without_webgl_the_page_says_so(page, dir):
    script = page.cdp("Page.addScriptToEvaluateOnNewDocument", source="""
        const getContext = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
          return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...more);
        };""")
    page.driver.get((dir / "plane.html").resolve().as_uri())
    page.cdp("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])
    message, end = "", time.time() + 60
    while not message and time.time() < end:
        message = page.run("const m = document.getElementById('message'); return m.checkVisibility() ? m.innerText : ''")
    assert "needs WebGL 2" in message, message
    assert page.run("return window.tufted.ready") is False


def test_saving_a_picture(page, dir):
    page.open(dir / "plane.html")
    with tempfile.TemporaryDirectory() as folder:
        page.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
        page.key("s", "KeyS")
        file = pathlib.Path(folder) / "plane.png"
        end = time.time() + 20
        while not file.exists() and time.time() < end:
            time.sleep(0.05)
        assert file.exists(), f"{list(pathlib.Path(folder).iterdir())}, must have plane.png"
        saved = file.read_bytes()
    width, height, pixel = pixels_of(saved)
    assert [width, height] == page.run("const c = document.getElementById('canvas'); return [c.width, c.height]")
    row = row_at(0.4, 0.2)
    close(pixel(*page.run("return tufted.place(arguments[0])", row)[:2]), page.color(row)[0])
    legend = page.run("const r = document.getElementById('legend').getBoundingClientRect(); return [r.left, r.right, r.top, r.bottom]")
    colors = {pixel(x, y) for x in range(round(legend[0]), round(legend[1])) for y in range(round(legend[2]), round(legend[3]))}
    viridis = map_colors(page, "viridis")
    assert any(max(abs(a - b) for a, b in zip(color, of_map(viridis, 0.5))) < 8 for color in colors), "has no legend"


def test_the_dialog_of_keys(page, dir):
    page.open(dir / "plane.html")
    is_open = "return document.getElementById('help').open"
    theme = "return document.documentElement.dataset.theme"
    before = page.run(theme)
    page.key("?", "Slash")
    assert page.run(is_open)
    assert "isolines" in page.run("return document.getElementById('help').innerText")
    page.key("t", "KeyT")
    assert page.run(theme) == before, "a key acts behind the dialog"
    page.run("document.querySelector('#help button').click()")
    assert not page.run(is_open)
    page.run("document.getElementById('help-button').click()")
    assert page.run(is_open)
    page.key("Escape", "Escape", windowsVirtualKeyCode=27)
    assert not page.run(is_open)
    page.run("document.getElementById('canvas').focus()")
    page.key("t", "KeyT")
    assert page.run(theme) != before


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
    wait(page)
    assert "</script>" in page.run("return document.getElementById('tip').textContent")
    assert page.run("return window.harm") is None
    untroubled(page, dir / "hostile.html")


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
    pages = pathlib.Path(sys.argv[1])
    only = sys.argv[2:]
    failed = 0
    with browser() as page:
        for name, test in list(globals().items()):
            if not name.startswith("test_") or (only and name not in only):
                continue
            page.resize(*SIZE)
            page.prefer("light")
            try:
                test(page, pages)
                print(f"{name}: ok", flush=True)
            except Exception as error:  # the next tests say more
                failed += 1
                print(f"{name}: FAILED: {type(error).__name__}: {error}", flush=True)
    sys.exit(1 if failed else 0)
