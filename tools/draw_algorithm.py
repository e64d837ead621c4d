#!/usr/bin/env python3
"""Draws the steps of docs/algorithm.md: star.svg, sheets.svg, gluing.svg, flip.svg and boundary.svg.

    tools/draw_algorithm.py [docs/figures]

Stars are computed by empty circles and planes by least squares. The same bytes every time; needs Python alone.
"""
import itertools
import math
import sys

BLACK, GREY, PALE, THIN = "#222222", "#767676", "#e4e4e4", "#b5b5b5"
BLUE, ORANGE, PALE_BLUE, PALE_ORANGE = "#1f4e9c", "#c8640a", "#e3ebf7", "#fbe9d7"


def polar(centre, radius, degrees):
    """Counterclockwise, although y points down in a drawing."""
    return moved(centre, radius * math.cos(math.radians(degrees)), -radius * math.sin(math.radians(degrees)))


def direction(a, b):
    """From a to b, in degrees as polar() takes them."""
    return math.degrees(math.atan2(a[1] - b[1], b[0] - a[0]))


def moved(a, x, y):
    return a[0] + x, a[1] + y


def circle_through(a, b, c):  # centre and radius
    bx, by, cx, cy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    twice, bb, cc = 2 * (bx * cy - by * cx), bx * bx + by * by, cx * cx + cy * cy
    x, y = (cy * bb - by * cc) / twice, (bx * cc - cx * bb) / twice
    return moved(a, x, y), math.hypot(x, y)


def delaunay_star(p, points):
    """Circles through p and two others that have no point inside: {pair: (centre, radius)}."""
    circles = {pair: circle_through(p, *pair) for pair in itertools.combinations(points, 2)}
    return {pair: (centre, radius) for pair, (centre, radius) in circles.items()
            if all(math.dist(centre, q) > radius for q in points if q not in pair)}


def fitted_line(points):
    """Centroid and direction of the line of least squares."""
    x, y = (sum(axis) / len(points) for axis in zip(*points))
    xx, yy = sum((a - x) ** 2 for a, _ in points), sum((b - y) ** 2 for _, b in points)
    return (x, y), -math.degrees(math.atan2(2 * sum((a - x) * (b - y) for a, b in points), xx - yy) / 2)


class Drawing:  # elements of an SVG file, from back to front
    def __init__(self, width, height, title):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" role="img" '
                      f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="14">',
                      f"<title>{title}</title>", f'<rect width="{width}" height="{height}" fill="white"/>']

    def path(self, *commands, colour=BLACK, width=1.5, dash="none", fill="none"):
        words = " ".join(c if isinstance(c, str) else f"{c[0]:.1f},{c[1]:.1f}" for c in commands)
        self.parts.append(f'<path d="{words}" fill="{fill}" stroke="{colour}" stroke-width="{width}" '
                          f'stroke-linecap="round" stroke-linejoin="round" stroke-dasharray="{dash}"/>')

    def line(self, a, b, colour=BLACK, width=1.5, dash="none"):
        self.path("M", a, "L", b, colour=colour, width=width, dash=dash)

    def polygon(self, *corners, colour="none", fill=PALE_BLUE):
        self.path("M", corners[0], "L", *corners[1:], "Z", colour=colour, fill=fill)

    def circle(self, centre, radius, colour=BLACK, dash="none", fill="none"):
        self.parts.append(f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:.1f}" stroke="{colour}" '
                          f'fill="{fill}" stroke-width="1.5" stroke-dasharray="{dash}"/>')

    def dots(self, points, colour=BLACK):
        for point in points:
            self.circle(point, 4, colour, fill=colour)

    def arrow(self, tail, tip, colour=BLACK):
        self.line(tail, tip, colour)
        back = direction(tip, tail)
        self.path("M", polar(tip, 9, back + 25), "L", tip, polar(tip, 9, back - 25), colour=colour)

    def text(self, at, words, colour=BLACK, anchor="middle", size=14):
        style = "italic" if len(words) == 1 and words.isalpha() else "normal"  # names of points
        self.parts.append(f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" fill="{colour}" text-anchor="{anchor}" '
                          f'font-style="{style}" font-size="{size}">{words}</text>')


def star(drawing):
    p, places = (220, 210), [(78, 12), (92, 68), (70, 121), (88, 176), (80, 238), (86, 300), (141, 40), (150, 97),
                             (139, 148), (150, 205), (146, 268), (160, 327), (190, 4), (172, 168)]
    neighbors, searched = [polar(p, *place) for place in places], max(places)[0]
    triangles = delaunay_star(p, neighbors)
    link = [q for q in neighbors if any(q in pair for pair in triangles)]
    q, last, circle = link[0], link[-1], triangles[link[0], link[1]]
    assert all(2 * radius <= searched for _, radius in triangles.values()), "certain"
    drawing.circle(p, searched, GREY, dash="6 5")
    for pair in triangles:
        drawing.polygon(p, *pair, colour=BLACK)
        drawing.line(*pair, BLUE, 2.5)
    drawing.arrow(p, polar(p, searched, 219), GREY)
    drawing.circle(*circle, ORANGE)
    for points, colour in ((neighbors, GREY), (link, BLUE), ([p], BLACK)):
        drawing.dots(points, colour)
    drawing.text(moved(polar(p, searched, 219), -12, 16), "r", GREY)
    drawing.text(moved(polar(p, searched, 219), -5, 20), "k", GREY, size=10)
    drawing.text(moved(p, -30, 15), "p")
    for target, height, words, colour in [
            (polar(p, searched, 47), 50, "circle that was searched", GREY),
            (polar(*circle, 12), 115, "empty circle of one triangle", ORANGE), (q, 180, "link vertex", BLUE),
            (((q[0] + last[0]) / 2, (q[1] + last[1]) / 2), 235, "link edge", BLUE),
            (polar(p, 60, 300), 290, "spoke", BLACK), (neighbors[11], 345, "neighbour outside of the star", GREY)]:
        drawing.line(moved(target, 7, 0), (448, height - 5), THIN, 1)
        drawing.text((455, height), words, colour, "start")


def sheets(drawing):
    lower, upper = ([(300 + x, y - 0.06 * x + 6 * math.sin(1.7 * x)) for x in range(start, end, 31)]
                    for start, end, y in ((-217, 220, 195), (-31, 200, 110)))
    p, last = lower[7], max(lower + upper, key=lambda q: math.dist(lower[7], q))
    for points, right, style in ((lower + upper, 245, (GREY, 2, "7 5")), (lower, 310, (BLUE, 2))):
        centre, angle = fitted_line(points)
        drawing.line(polar(centre, -245, angle), polar(centre, right, angle), *style)
    height = {q: math.dist(p, q) * math.sin(math.radians(direction(p, q) - angle)) for q in lower + upper}
    top, bottom = min(map(height.get, upper)), max(map(height.get, lower))
    assert top - bottom > math.dist(p, last) / 4

    def on_axis(along, aside=0):
        return polar(polar(centre, 285 + aside, angle), along, angle + 90)

    drawing.arrow(on_axis(-30), on_axis(135))
    for sheet, colour in ((lower, BLUE), (upper, GREY), ([p], BLACK)):
        drawing.dots(sheet, colour)
        for q in sheet:
            drawing.line(on_axis(height[q], -6), on_axis(height[q], 6), colour)
    for a, b, ends in ((p, last, (bottom, top)), (last, p, (top, bottom))):
        drawing.line(moved(a, 0, 32), moved(a, 0, 58), THIN, 1)
        drawing.arrow(moved(a, 0, 50), moved(b, 0, 50), GREY)
        drawing.arrow(*[on_axis(end, 16) for end in ends], ORANGE)
    for at, words, colour in [
            (moved(p, -4, 24), "p", BLACK), ((200, 278), "S, to the last neighbour", GREY),
            ((145, 155), "wrong: plane of all neighbours", GREY), ((450, 235), "right: plane of the sheet of p", BLUE),
            ((370, 78), "another sheet, left out", GREY), ((560, 30), "heights along the normal", BLACK),
            (on_axis((top + bottom) / 2 - 5, 62), "gap > S/4", ORANGE)]:
        drawing.text(at, words, colour)


def draw_doubled(drawing, edge, angles, length, start, front=BLACK, half=7):
    """Triangles around an edge that is seen along it; the front of each is glued to the back of the next."""
    for angle, following in zip(angles, angles[1:] + angles[:1]):
        for turn, colour in ((90, front), (-90, BLACK)):
            drawing.line(*[polar(polar(edge, r, angle), half, angle + turn) for r in (start, length)], colour, 2)
        middle = (following - angle) % 360 / 2
        drawing.path("M", polar(polar(edge, start, angle), half, angle + 90), "Q",
                     polar(edge, half / math.sin(math.radians(middle)), angle + middle),
                     polar(polar(edge, start, following), half, following - 90), colour=ORANGE, width=3)
    drawing.dots([edge])


def draw_copies(drawing, at, names):
    """Triangles pqr and pqs of the stars of two points: spokes are solid, link edges dashed."""
    apart = 5 if names == "rs" else 0
    for third, centre, y, apex, fill in (("r", names[0], -apart, (105, -42 - apart), PALE_BLUE),
                                         ("s", names[1], apart, (70, 36 + apart), "none")):
        places = {"p": moved(at, 0, y), "q": moved(at, 170, y), third: moved(at, *apex)}
        drawing.polygon(*places.values(), fill=fill)
        for ends in itertools.combinations(places, 2):
            drawing.line(*map(places.get, ends), *((BLACK, 2) if centre in ends else (GREY, 1.5, "5 4")))
        drawing.dots([places[centre]])
        drawing.text(moved(places[third], 18, 5 + apex[1] / 8), third)


def gluing(drawing):
    draw_doubled(drawing, (135, 205), [80, 195, 320], 105, 30, BLUE)
    for at, words, colour in [
            ((135, 30), "Algorithm 1, around an edge", BLACK), ((108, 136), "front", BLUE), ((182, 139), "back", BLACK),
            ((156, 92), "1", BLACK), ((19, 241), "2", BLACK), ((227, 287), "3", BLACK),
            ((135, 350), "the front of each is glued", ORANGE), ((135, 372), "to the back of the next", ORANGE),
            ((525, 30), "Gluing::star, copies at the edge pq", BLACK), ((635, 66), "seen along pq", GREY),
            ((525, 466), "solid: spokes; dashed: link edges; blue: the copies of pqr", GREY)]:
        drawing.text(at, words, colour)
    drawing.line((280, 20), (280, 460), PALE)
    for names, y, words in (("pp", 95, "star of p: its spoke pq is glued within the star"),
                            ("qq", 232, "star of q: its spoke pq is glued within the star"),
                            ("rs", 369, "stars of r and s share the link edge pq")):
        draw_copies(drawing, (325, y), names)
        draw_doubled(drawing, (635, y), [0, 180], 65, 24)
        for x, name in ((311, "p"), (509, "q"), (556, "r"), (714, "s")):
            drawing.text((x, y + 5), name)
        drawing.text((525, y + 67), words, ORANGE)


def flip(drawing):
    for left, edge, angles, words, reason in (
            (60, "ij", ("kijα", "mjiβ"), "α + β > π: ij is not Delaunay", "the circle through i, j, k holds m"),
            (440, "km", ("imkγ", "jkmδ"), "γ + δ &lt; π: km is Delaunay", "that through k, m, i leaves j out")):
        at = {"i": (left, 107), "j": (left + 220, 117), "k": (left + 95, 49), "m": (left + 125, 179)}
        drawing.polygon(*map(at.get, "ikjm"), colour=BLACK)
        drawing.circle(*circle_through(*map(at.get, angles[0][:3])), THIN, "6 5")
        for apex, a, b, sign in angles:
            first, last = direction(at[apex], at[a]), direction(at[apex], at[b])
            drawing.path("M", polar(at[apex], 20, first), "A", (20, 20), "0 0 0", polar(at[apex], 20, last),
                         colour=ORANGE, width=2)
            drawing.text(moved(polar(at[apex], 35, first + (last - first) % 360 / 2), 0, 5), sign, ORANGE)
        drawing.line(*map(at.get, edge), BLUE, 2.5)
        drawing.dots(at.values())
        for corner, x, y in (("i", -14, 5), ("j", 14, 5), ("k", 0, -11), ("m", 0, 22)):
            drawing.text(moved(at[corner], x, y), corner)
        drawing.text((left + 110, 330), words)
        drawing.text((left + 110, 354), reason, GREY)
    drawing.arrow((330, 112), (390, 112))
    drawing.text((360, 99), "flip")


def boundary(drawing):
    for at, words in (((55, 123), "from above"), ((55, 243), "from the side"), (
            (380, 364), "shaded: where points are looked for, and S/4 to both sides of the tangent plane")):
        drawing.text(at, words, GREY)
    around, beyond = [(45, 100), (42, 142), (46, 180), (41, 220), (45, 262)], [(60, 28), (80, -28), (87, 4)]
    for x, name, found, colour, depth, words, more in (
            (210, "rim", [], BLACK, 0, "nothing lies", "beyond the gap"),
            (415, "jump", beyond, ORANGE, 34, "another surface, off", "the tangent plane"),
            (620, "lost", beyond, BLUE, 0, "the same surface", "goes on")):
        above, aside, reach, half = (x, 118), (x, 238), 2 * max(around)[0], 49.5  # of the gap from 262 to 100 degrees
        drawing.path("M", above, "L", polar(above, reach, -half), "A", (reach, reach), "0 0 0",
                     polar(above, reach, half), "Z", colour="none", fill=PALE_ORANGE)
        drawing.path("M", moved(aside, -60, -14), "h 172 v 28 h -172 Z", colour="none", fill=PALE)
        drawing.path("M", moved(aside, -60, 0), "h 172", colour=GREY, width=1, dash="5 4")
        link = [polar(above, *place) for place in around]
        for ends in zip(link, link[1:]):
            drawing.polygon(above, *ends, colour=BLACK)
        drawing.dots([above, aside, *link, moved(aside, -49, 2), moved(aside, -24, -3)])
        for place in found:
            drawing.dots([polar(above, *place), moved(aside, polar((0, 0), *place)[0], depth + place[1] / 9)], colour)
        for at, word in (((10, 104), "p"), ((0, 217), "p"), ((22, 28), name), ((22, 305), words), ((22, 325), more)):
            drawing.text(moved(at, x, 0), word)


def main(folder="docs/figures"):
    for draw, width, height, title in (
            (star, 720, 420, "The Delaunay star of a point p among its neighbours in the tangent plane"),
            (sheets, 720, 290, "Two nearby sheets: the plane across both, and the plane of the sheet of p"),
            (gluing, 760, 480, "Gluing the fronts and backs of triangles around an edge, and within a star"),
            (flip, 720, 370, "An edge ij that is not Delaunay is flipped to km"),
            (boundary, 760, 380, "What lies beyond the gap of a star: a rim, a jump or lost triangles")):
        draw(drawing := Drawing(width, height, title))
        with open(f"{folder}/{draw.__name__}.svg", "w", encoding="utf-8", newline="\n") as file:
            file.write("\n".join([*drawing.parts, "</svg>", ""]))


if __name__ == "__main__":
    main(*sys.argv[1:])
