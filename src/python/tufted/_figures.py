"""The methods of Surface that show it: pictures, pages, and what a notebook shows."""
import html

import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Page, Picture
from ._tufted import InvalidInput

# A notebook shows surfaces of up to this many points as a page, which adds up to some ten megabytes to its file.
_LARGEST_PAGE = 500_000

_ALL_COLUMNS = ("vector", "coordinates", "color", "direction")  # kinds whose columns are shown together
_AXES = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}


@check.public
class Figures:
    def picture(self, values=None, *, kind=None, column=None, line=None, size=(1200, 900), camera=None, up=None,
                color_map=None, range=None, isolines=None, background="white", light=True, legend=True, title=None):
        """Draws the surface with values at its points, as `tufted view --png` does, without a screen. At the end of a
        notebook's cell the result shows itself.

        values: N, N x c, or a dict of such by name, of which the first is shown; None: the shape alone.
        kind: meaning of the values, or a dict of it by name: "scalar", "positive" (on a logarithmic scale), "diverging"
        (around 0), "distance" (with isolines), "label", "vector" (N x 3, arrows), "coordinates" (N x 2, a grid of
        lines), "color" (N x 3, 0 to 255) or "direction" (N x 3, unit vectors). None: "label" for integers and booleans,
        "vector" for N x 3, otherwise "scalar".
        column: which one is shown, counted from 0; None: the first that is not constant.
        line: a line on the surface: K x 3 points, a result of path(), path_through() or trace(), or one of the lines of
        isolines().
        size: width and height in pixels, 16 to 8192.
        camera: (azimuth, elevation) in degrees or (azimuth, elevation, zoom); "top": a plan in parallel projection;
        None: chosen. up: the axis that points up: "x", "y", "z", "-x", "-y" or "-z"; None: chosen.
        color_map: "viridis", "cividis", "magma", "coolwarm", "purple_green" or "labels"; None: by kind.
        range: the values at both ends of the colour map; None: the least and the greatest except outliers.
        isolines: whether lines of equal values are drawn; None: for distances only.
        background: "white", "dark" or "transparent". light: whether the surface is shaded. legend: whether title and
        legend are drawn. title: None: the name of the file or class.
        Returns a Picture: `png` are the bytes of a PNG file, save(path) writes them.

        >>> cloud = tufted.PointCloud(points)
        >>> picture = cloud.picture(cloud.distance(0), kind="distance", camera=(30, 20), size=(400, 300))
        >>> picture.png[1:4]
        b'PNG'
        """
        scene, look = self._scene("picture", values, kind, column, line, camera, up, color_map, title)
        pixels = check.integers("picture", "size", size)
        ends = None if range is None else check.columns("picture", "range", range, 2)[0]
        if ends is not None and ends.shape != (2, 1):
            raise InvalidInput(f"picture: range has the shape {' x '.join(map(str, ends.shape))}, must be 2")
        if pixels.shape != (2,):
            raise InvalidInput(f"picture: size = {size!r}, must be (width, height)")
        background = check.text("picture", "background", background)
        isolines = None if isolines is None else check.flag("picture", "isolines", isolines)
        return Picture(_tufted.picture(
            scene, look, pixels.tolist(), background, None if ends is None else ends[:, 0], isolines,
            check.flag("picture", "light", light), check.flag("picture", "legend", legend), self._solving["threads"]))

    def page(self, values=None, path=None, *, kind=None, column=None, line=None, camera=None, up=None, color_map=None,
             title=None):
        """Makes an HTML page that shows the surface with values at its points, as `tufted view` does. It needs no
        network, and in it one turns the surface, chooses fields, colours and isolines, and reads values.

        values: as in picture(); all entries of a dict can be chosen in the page. None: the areas of the points, their
        components and the boundary.
        path: a file to which the page is written; None: none. Raises IoError if it cannot be written.
        kind, column, line, camera, up, color_map, title: as in picture(); what the page shows at first.
        Returns the text of the page. A notebook shows it as an interactive view.
        """
        path = None if path is None else check.path("page", "path", path)
        scene, look = self._scene("page", values, kind, column, line, camera, up, color_map, title,
                                  self._own_fields if values is None else None)
        page = Page(_tufted.page(scene, look))
        if path is not None:
            check.write(path, page.encode("utf-8"))
        return page

    def _repr_html_(self):
        if len(self) > _LARGEST_PAGE:
            return f"<pre>{html.escape(repr(self))}</pre>"
        return self.page()._repr_html_(repr(self))

    def _own_fields(self):
        """What is shown of a surface without values, as name, kind, values, unit, names of labels, and what grey is."""
        labels = self.components.astype(np.float64).reshape(-1, 1)
        boundary = self.boundary.astype(np.float64).reshape(-1, 1) - 1  # "none" becomes -1, drawn grey
        return [("area of a point", "positive", self.M.reshape(-1, 1), "", [], ""),
                ("component", "label", labels, "", [], ""),
                ("boundary", "label", boundary, "", ["rim", "jump", "lost"], "none")]

    def _scene(self, function, values, kind, column, line, camera, up, color_map, title, own_fields=None):
        """The scene, and the options that pages and pictures share."""
        names = values.keys() if isinstance(values, dict) else () if values is None else ("values",)
        for name in kind.keys() - set(names) if isinstance(kind, dict) else ():
            raise InvalidInput(f"{function}: kind has the name {name!r}, must be one of values")
        fields = own_fields() if own_fields else self._fields(function, values, kind)
        faces = np.zeros((0, 3), np.int32) if self._faces is None else self._faces
        line = np.zeros((0, 3)) if line is None else check.rows_of_three(function, "line",
                                                                        getattr(line, "points", line))
        name = self._source or f"tufted.{type(self).__name__}" if title is None else str(title)
        scene = _tufted.Scene(name, self._points, faces, self._frame_parts()[0], fields, line)
        shown = -1 if not fields else 0
        color_map = "" if color_map is None else check.text(function, "color_map", color_map)
        look = {"field": shown, "column": _column(function, fields, column), "color_map": color_map,
                "up": _axis(function, up), **_camera(function, camera)}
        return scene, look

    def _fields(self, function, values, kind):
        if values is None:
            return []
        named = values if isinstance(values, dict) else {"values": values}
        kinds = kind if isinstance(kind, dict) else dict.fromkeys(named, kind)
        fields = []
        for name, given in named.items():
            given = check.array(function, "values", given)
            is_label = given.dtype.kind in "iub"
            table, _ = check.columns(function, "values", given.astype(float) if is_label else given, len(self))
            usual = "label" if is_label else "vector" if table.shape[1] == 3 else "scalar"
            chosen = kinds.get(name)
            chosen = usual if chosen is None else check.text(function, "kind", chosen)
            fields.append((str(name), chosen, table, "", [], ""))
        return fields


def _column(function, fields, column):
    """The column of the first field that is shown; None: the first that is not constant."""
    if column is not None:
        return check.whole(function, "column", column, 0)
    if not fields or fields[0][1] in _ALL_COLUMNS:
        return 0
    table = fields[0][2]
    varying = [k for k, values in enumerate(table.T) if _varies(values[np.isfinite(values)])]
    return varying[0] if varying else 0


def _varies(values):
    """Whether values differ by more than the rounding of a solve; the first eigenvectors are constant."""
    return np.ptp(values) > 1e-6 * abs(values).max() if values.size else False


def _axis(function, up):
    if up is None:
        return np.zeros(3)
    if not isinstance(up, str) or up.lstrip("-") not in _AXES or up.count("-") > 1:
        raise InvalidInput(f"{function}: up = {up!r}, must be one of 'x', 'y', 'z', '-x', '-y', '-z'")
    return np.array(_AXES[up[-1]]) * (-1 if up[0] == "-" else 1)


def _camera(function, camera):
    if camera is None or isinstance(camera, str):
        if camera not in (None, "top"):
            raise InvalidInput(f"{function}: camera = {camera!r}, must be 'top' or angles")
        azimuth, elevation = (None, None) if camera is None else (-90.0, 90.0)
        return {"azimuth": azimuth, "elevation": elevation, "zoom": 1.0, "is_parallel": camera == "top"}
    numbers = check.values(function, "camera", camera)
    if numbers.size not in (2, 3):
        raise InvalidInput(f"{function}: camera = {camera!r}, must be (azimuth, elevation) or (azimuth, elevation, "
                           "zoom)")
    azimuth, elevation, zoom = (*numbers, 1.0)[:3]
    return {"azimuth": azimuth, "elevation": elevation, "zoom": zoom, "is_parallel": False}
