// Normals, curvature, triangles and segments of a surface.
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/curvature.h"
#include "tufted/gradient.h"
#include "tufted/nearest_point.h"
#include "tufted/normals.h"
#include "tufted/polygons.h"
#include "tufted/segments.h"
#include "tufted/surface_triangles.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

Frames framesFrom(Points normals, Points tangents, int orientation) {
  return {std::move(normals), std::move(tangents), static_cast<Orientation>(orientation)};
}

py::tuple tupleOf(Frames frames) {
  return py::make_tuple(std::move(frames.normals), std::move(frames.tangents));
}

py::tuple oriented(const Laplacian& laplacian, Points normals, Points tangents, int orientation,
                   const std::optional<Eigen::Vector3d>& viewpoint, const std::optional<Eigen::Vector3d>& up,
                   int threads, const py::object& progress) {
  const Frames frames = framesFrom(std::move(normals), std::move(tangents), orientation);
  return tupleOf(run(progress, [&](const Progress& called) {
    return orientedFrames(laplacian, frames,
                          {.viewpoint = viewpoint ? &*viewpoint : nullptr,
                           .up = up ? &*up : nullptr,
                           .threads = threads,
                           .progress = called});
  }));
}

py::tuple curvature(const Laplacian& laplacian, Points normals, Points tangents, const std::string& method, int rings,
                    int threads, const py::object& progress) {
  const Frames frames = framesFrom(std::move(normals), std::move(tangents), static_cast<int>(Orientation::consistent));
  CurvatureOptions options = {
      .method = chosen<CurvatureMethod>("curvature: method", method,
                                        {{"fit", CurvatureMethod::fit}, {"laplacian", CurvatureMethod::laplacian}}),
      .rings = rings,
      .threads = threads};
  Curvatures found = run(progress, [&](const Progress& called) {
    options.progress = called;
    return curvatures(laplacian, frames, options);
  });
  return py::make_tuple(std::move(found.mean), std::move(found.gaussian), std::move(found.principal),
                        std::move(found.first), std::move(found.second));
}

py::tuple segmentsOf(const Laplacian& laplacian, Points normals, Points tangents, const std::string& method,
                     std::optional<int> count, const Integers& seeds, double crease, int least_points,
                     const Solving& solving, const py::object& progress) {
  const Frames frames = framesFrom(std::move(normals), std::move(tangents), static_cast<int>(Orientation::consistent));
  SegmentOptions options = {.method = chosen<SegmentMethod>("segments: method", method,
                                                            {{"voronoi", SegmentMethod::voronoi},
                                                             {"spectral", SegmentMethod::spectral},
                                                             {"parts", SegmentMethod::parts}}),
                            .count = count,
                            .seeds = indicesOf(seeds),
                            .crease = crease,
                            .least_points = least_points};
  Segments found = run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return segments(laplacian, frames, options);
  });
  return py::make_tuple(owned(std::move(found.labels)), std::move(found.areas), owned(std::move(found.seeds)));
}

/// The triangles of polygons.
/// @param corners indices of all polygons, one after the other
/// @param counts the number of corners of each, their sum is that of `corners`
Triangles triangulated(const Doubles& points, const Integers& corners, const Integers& counts) {
  Polygons polygons;
  const int* corner = corners.data();
  for (const int count : indicesOf(counts)) {
    polygons.emplace_back(corner, corner + count);
    corner += count;
  }
  const Points all = pointsOf(points);
  return run(py::none(), [&](const Progress& called) { return triangulate(all, polygons, called); });
}

/// The faces of the tufted cover, F x 3, after flips.
py::array_t<int> coverFaces(const Laplacian& laplacian) {
  const auto* const cover = run(py::none(), [&](const Progress&) { return &laplacian.cover(); });
  std::vector<int> corners;
  corners.reserve(3 * cover->faces.size());
  for (const std::array<int, 3>& face : cover->faces) corners.insert(corners.end(), face.begin(), face.end());
  return owned(std::move(corners)).reshape({-1, 3});
}

}  // namespace

void addShape(py::module_& module) {
  module.def("mesh_frames", [](const Laplacian& laplacian, const Doubles& points, const Integers& faces) {
    const auto view = pointsOf(points);
    const auto triangles = trianglesOf(faces);
    Frames frames = [&] {
      const py::gil_scoped_release release;
      return meshFrames(laplacian, view, triangles);
    }();
    const auto orientation = static_cast<int>(frames.orientation);
    return py::make_tuple(tupleOf(std::move(frames)), orientation);
  });
  module.def("oriented_frames", &oriented);
  module.def("curvature", &curvature);
  module.def("segments", &segmentsOf);
  module.def("triangles", [](const Laplacian& laplacian, const py::object& progress) {
    return run(progress, [&](const Progress& called) {
      return surfaceTriangles(laplacian, TriangleOptions{.progress = called});
    });
  });
  module.def("triangulate", &triangulated);
  module.def("cover_faces", &coverFaces);
  module.def("nearest", [](const Laplacian& laplacian, const Doubles& points, const Doubles& positions,
                           const py::object& progress) {
    const auto view = pointsOf(points), targets = pointsOf(positions);
    return owned(
        run(progress, [&](const Progress& called) { return nearestPoints(laplacian, view, targets, called); }));
  });
}

}  // namespace tufted::python
