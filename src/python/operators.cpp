// Gradients and divergence, and the check of what a Laplacian promises.
#include <optional>
#include <utility>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/check.h"
#include "tufted/gradient.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Calls gradients().
/// @param frames normals and tangents of the planes; none: planes are fitted, which needs the frames of a cloud
Gradients gradientsOf(const Laplacian& laplacian, const Doubles& points,
                      const std::optional<std::pair<Points, Points>>& frames, const std::optional<int>& neighbors,
                      double regularization, int threads, const py::object& progress) {
  GradientOptions options = {.neighbors = neighbors, .regularization = regularization, .threads = threads};
  const auto view = pointsOf(points);
  return run(progress, [&](const Progress& called) {
    options.progress = called;
    if (!frames) return gradients(laplacian, view, options);
    return gradients(laplacian, view, Frames{frames->first, frames->second, Orientation::given}, options);
  });
}

py::dict validated(const Laplacian& laplacian, const py::object& progress) {
  const LaplacianCheck check = run(progress, [&](const Progress& called) { return validate(laplacian, called); });
  py::dict result;
  result["ok"] = check.ok();
  result["faults"] = check.faults;
  result["not_checked"] = check.not_checked;
  result["status"] = check.status;
  result["components"] = check.components;
  result["nonzeros_per_row"] = check.nonzeros_per_row;
  result["positive_off_diagonals"] = check.positive_off_diagonals;
  result["not_finite"] = check.not_finite;
  result["not_positive_diagonals"] = check.not_positive_diagonals;
  result["negative_masses"] = check.negative_masses;
  result["zero_masses"] = check.zero_masses;
  result["inactive_not_zero"] = check.inactive_not_zero;
  result["symmetry_error"] = check.symmetry_error;
  result["row_sum_error"] = check.row_sum_error;
  result["definite"] = check.definite;
  if (check.surface) {
    result["weight_error"] = check.surface->weight_error;
    result["area_error"] = check.surface->area_error;
    result["mass_error"] = check.surface->mass_error;
    result["masses_compared"] = check.surface->masses_compared;
  }
  return result;
}

}  // namespace

void addOperators(py::module_& module) {
  py::class_<Gradients>(module, "Gradients")
      .def_property_readonly("X", [](const py::object& self) { return shownSparse(self.cast<Gradients&>().X, self); })
      .def_property_readonly("Y", [](const py::object& self) { return shownSparse(self.cast<Gradients&>().Y, self); })
      .def_property_readonly("normals", [](const Gradients& found) { return found.frames.normals; })
      .def_property_readonly("tangents", [](const Gradients& found) { return found.frames.tangents; });
  module.def("gradients", &gradientsOf);
  module.def("divergence", [](const Laplacian& laplacian, const Gradients& gradients, const Eigen::MatrixX2d& vectors) {
    const py::gil_scoped_release release;
    return divergence(laplacian, gradients, vectors);
  });
  module.def("validate", &validated);
}

}  // namespace tufted::python
