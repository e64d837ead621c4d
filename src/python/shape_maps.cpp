// Maps between two shapes.
#include "tufted/shape_maps.h"

#include <utility>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

Eigen::MatrixXd mapped(const Laplacian& source, const Spectrum& of_source, const Laplacian& target,
                       const Spectrum& of_target, Eigen::MatrixXd source_descriptors,
                       Eigen::MatrixXd target_descriptors, VectorXd weights, const Integers& landmarks, int k,
                       double commutativity, const py::object& progress) {
  FunctionalMapOptions options = {.k = k,
                                  .commutativity = commutativity,
                                  .source_descriptors = std::move(source_descriptors),
                                  .target_descriptors = std::move(target_descriptors),
                                  .weights = std::move(weights)};
  for (py::ssize_t l = 0; l < landmarks.size() / 2; ++l)
    options.landmarks.push_back({landmarks.data()[2 * l], landmarks.data()[2 * l + 1]});
  return run(progress, [&](const Progress& called) {
    options.progress = called;
    return functionalMap({source, of_source}, {target, of_target}, options);
  });
}

/// @tparam Start a map of coefficients, or indices
template <class Start>
Eigen::MatrixXd refined(const Laplacian& source, const Spectrum& of_source, const Laplacian& target,
                        const Spectrum& of_target, const Start& start, int k, int step, int samples, int threads,
                        const py::object& progress) {
  return run(progress, [&](const Progress& called) {
    return zoomOut({source, of_source}, {target, of_target}, start,
                   {.k = k, .step = step, .samples = samples, .threads = threads, .progress = called});
  });
}

py::tuple pointsMapped(const Laplacian& source, const Spectrum& of_source, const Laplacian& target,
                       const Spectrum& of_target, const Eigen::MatrixXd& C, int threads, const py::object& progress) {
  PointMaps maps = run(progress, [&](const Progress& called) {
    return pointMaps({source, of_source}, {target, of_target}, C, threads, called);
  });
  return py::make_tuple(owned(std::move(maps.to_target)), owned(std::move(maps.to_source)));
}

}  // namespace

void addShapeMaps(py::module_& module) {
  module.def("functional_map", &mapped);
  module.def("zoom_out", &refined<Eigen::MatrixXd>);
  module.def("zoom_out_points", &refined<std::vector<int>>);
  module.def("point_maps", &pointsMapped);
}

}  // namespace tufted::python
