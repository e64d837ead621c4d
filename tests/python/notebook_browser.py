#!/usr/bin/env python3
"""Looks at what a notebook shows of a cloud and of a mesh, in a headless Chromium: notebook_browser.py [PICTURE.png]

The server and the page do what Jupyter does: cells are written into the page by innerHTML, so that scripts of the
output itself would not run, and the policy of the server is that of Jupyter Server.
"""
import functools
import http.server
import pathlib
import sys
import tempfile
import threading
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "view"))
from browser import browser, pixels_of  # noqa: E402

import tufted  # noqa: E402
from support import sphere, torus_mesh  # noqa: E402

NOTEBOOK = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>notebook</title><link rel="icon" href="data:,">
<style>body { margin: 0; background: white; font: 14px sans-serif } .jp-OutputArea-output { margin: 8px }</style></head>
<body><div id="cells"></div><script>
for (const name of ["cloud", "mesh"])
  fetch(name + ".txt").then((answer) => answer.text()).then((text) => {
    const cell = document.createElement("div");
    cell.className = "jp-RenderedHTMLCommon jp-RenderedHTML jp-OutputArea-output";
    cell.id = name;
    cell.innerHTML = text;
    document.getElementById("cells").append(cell);
  });
</script></body></html>"""


class Server(http.server.SimpleHTTPRequestHandler):
    def end_headers(self):
        self.send_header("Content-Security-Policy", "frame-ancestors 'self'; report-uri /api/security/csp-report")
        super().end_headers()

    def log_message(self, *_):
        pass


def frame_of(page, name):
    """The frame of an output, and where it lies."""
    end = time.time() + 60
    while not (found := page.driver.find_elements("css selector", f"#{name} iframe")):
        assert time.time() < end, f"no output of the {name}: {page.errors()}"
        time.sleep(0.02)
    page.run("arguments[0].scrollIntoView()", found[0])
    return found[0], page.run("const r = arguments[0].getBoundingClientRect(); return [r.x, r.y, r.width, r.height]",
                              found[0])


def places_of(page, frame, rows):
    """Where points lie in the frame that nothing covers, and the colour behind them."""
    page.driver.switch_to.frame(frame)
    try:
        end = time.time() + 60
        while not page.run("return window.tufted?.ready"):
            assert time.time() < end, f"the output shows nothing: {page.run('return document.body.innerText')!r}"
            time.sleep(0.02)
        assert page.run("return tufted.stage.renderer.getContext().getParameter(7938)").startswith("WebGL")
        page.run("tufted.stage.drawNow()")
        places = page.run("""
          const canvas = document.getElementById('canvas');
          return arguments[0].map((row) => tufted.place(row).slice(0, 2))
                             .filter(([x, y]) => document.elementFromPoint(x, y) === canvas);""", rows)
        behind = page.run("return tufted.stage.scene.background.toArray().map((c) => Math.round(255 * c))")
        return places, behind
    finally:
        page.driver.switch_to.default_content()


def check(page, name, count, picture):
    frame, (left, top, width, height) = frame_of(page, name)
    assert width > 600 and height == 480, (width, height)
    places, behind = places_of(page, frame, list(range(0, count, 7)))
    assert len(places) > count / 14, f"of {count // 7} points of the {name} {len(places)} can be seen"
    # Until the frame has been put onto the page.
    page.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    _, _, color = pixels_of(page.screenshot(picture))
    differ = [max(abs(a - b) for a, b in zip(color(left + x, top + y), behind)) > 25 for x, y in places]
    assert sum(differ) > 0.95 * len(places), \
        f"{sum(differ)} of {len(places)} places of points of the {name} have a colour"
    x, y = 8, height - 8  # a corner of the frame, where nothing is
    assert max(abs(a - b) for a, b in zip(color(left + width / 2, top + y), behind)) <= 3
    print(f"{name}: {sum(differ)} of {len(places)} places of points have a colour")


def main():
    picture = sys.argv[1] if len(sys.argv) > 1 else None
    points, faces = torus_mesh(60, 30)
    surfaces = {"cloud": tufted.PointCloud(sphere(3000)), "mesh": tufted.Mesh(points, faces)}
    with tempfile.TemporaryDirectory() as folder, browser() as page:
        pathlib.Path(folder, "notebook.html").write_text(NOTEBOOK)
        for name, surface in surfaces.items():
            pathlib.Path(folder, f"{name}.txt").write_text(surface._repr_html_())
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=folder))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            page.resize(1000, 1040)
            page.requests()  # those of the browser's own first page
            page.driver.get(f"http://127.0.0.1:{server.server_port}/notebook.html")
            for name, surface in surfaces.items():
                check(page, name, len(surface), picture)
            errors = page.errors()
            assert not errors, errors
            own = f"http://127.0.0.1:{server.server_port}/"
            others = [url for url in page.requests() if not url.startswith((own, "data:", "about:", "blob:"))]
            assert not others, others
        finally:
            server.shutdown()


if __name__ == "__main__":
    main()
