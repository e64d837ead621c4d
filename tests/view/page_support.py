"""What tests of pages in a browser share: the squares of page_sample, colours, waiting, and how tests are run."""
import pathlib
import sys

from browser import browser

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


def run_tests(tests):
    """Runs the functions among `tests` whose names begin with test_: PROGRAM DIR [NAME...]."""
    pages, only, failed = pathlib.Path(sys.argv[1]), sys.argv[2:], 0
    with browser() as page:
        for name, test in tests.items():
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
