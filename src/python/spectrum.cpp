// Eigenpairs, and signatures, embeddings and filters from them.
#include "tufted/spectrum.h"

#include <string>
#include <utility>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/interpolation.h"
#include "tufted/signatures.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

Spectrum spectrumOf(const Laplacian& laplacian, int k, bool null_space, double tolerance, const Solving& solving,
                    const py::object& progress) {
  SpectrumOptions options = {.tolerance = tolerance,
                             .null_space = null_space,
                             .method = solving.method(),
                             .memory_limit = solving.memory_limit,
                             .threads = solving.threads};
  return run(progress, [&](const Progress& called) {
    options.progress = called;
    return spectrum(laplacian, k, options);
  });
}

/// Filters what signals have beside their means over components, and adds the means unfiltered.
Eigen::MatrixXd filtered(const Laplacian& laplacian, const Spectrum& spectrum, const Eigen::MatrixXd& signals,
                         const py::object& gain) {
  std::function<double(double)> factor;
  if (!gain.is_none()) {
    factor = [&gain](double eigenvalue) {
      const py::gil_scoped_acquire acquire;
      return gain(eigenvalue).cast<double>();
    };
  }
  const py::gil_scoped_release release;
  const Eigen::MatrixXd means = componentMeans(laplacian, signals);
  return means + filterSignals(laplacian, spectrum, signals - means, factor);
}

/// A spectrum from the two arrays in which Python holds it.
Spectrum pairsFrom(VectorXd values, Eigen::MatrixXd vectors) {
  if (values.size() != vectors.cols())
    throw InvalidInput("spectrum: has " + std::to_string(values.size()) + " values and " +
                       std::to_string(vectors.cols()) + " vectors, must have as many");
  return {std::move(values), std::move(vectors), {}};
}

}  // namespace

void addSpectrum(py::module_& module) {
  py::class_<Solving>(module, "Solving")
      .def(py::init([](std::string solver, std::size_t memory_limit, int threads) {
             return Solving{std::move(solver), memory_limit, threads};
           }),
           py::arg("solver"), py::arg("memory_limit"), py::arg("threads"));
  py::class_<Spectrum>(module, "Spectrum")
      .def(py::init(&pairsFrom))
      .def_readonly("values", &Spectrum::values)
      .def_readonly("vectors", &Spectrum::vectors)
      .def("positive", [](const Spectrum& all) {  // the pairs whose eigenvalue is not 0
        const Eigen::Index zeros = (all.values.array() <= 0).count();
        return Spectrum{all.values.tail(all.values.size() - zeros), all.vectors.rightCols(all.values.size() - zeros),
                        all.report};
      });
  module.def("spectrum", &spectrumOf);
  module.def("most_eigenpairs", &mostEigenpairs);
  module.def("heat_times", &heatTimes);
  module.def("hks", [](const Laplacian& laplacian, const Spectrum& spectrum, const VectorXd& times) {
    const py::gil_scoped_release release;
    return heatKernelSignature(laplacian, spectrum, times);
  });
  module.def("wave_energies", &waveEnergies);
  module.def("wks", [](const Spectrum& spectrum, int count) {
    const py::gil_scoped_release release;
    return waveKernelSignature(spectrum, count);
  });
  module.def("wks_at", [](const Spectrum& spectrum, const VectorXd& energies, double width) {
    const py::gil_scoped_release release;
    return waveKernelSignature(spectrum, energies, width);
  });
  module.def("embed", [](const Spectrum& spectrum, const std::string& distance) {
    const auto embedding = chosen<Embedding>("embed: distance", distance,
                                             {{"commute", Embedding::commute}, {"biharmonic", Embedding::biharmonic}});
    return spectralEmbedding(spectrum, embedding);
  });
  module.def("filter", &filtered);
}

}  // namespace tufted::python
