#!/usr/bin/env python3
"""Mouse, touch, keys and options of the pages of page_sample in a headless Chromium: page_handling.py DIR [TEST...]"""
import math
import pathlib
import tempfile
import time

from browser import pixels_of
from page_support import close, map_colors, of_map, row_at, run_tests, SIZE, untroubled, wait


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


if __name__ == "__main__":
    run_tests(globals())
