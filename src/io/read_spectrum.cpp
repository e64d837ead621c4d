#include <algorithm>
#include <string>

#include "io/errors.h"
#include "io/result_folder.h"
#include "tufted/check.h"
#include "tufted/io/results.h"

namespace tufted {
namespace {

using Path = std::filesystem::path;

/// The greatest |L x - lambda M x| / (lambda |M x|) over the positive eigenvalues.
double greatestResidual(const Laplacian& laplacian, const Spectrum& spectrum) {
  double greatest = 0;
  for (Eigen::Index k = 0; k < spectrum.values.size(); ++k) {
    const double value = spectrum.values[k];
    if (value == 0) continue;
    const VectorXd right = value * laplacian.M.cwiseProduct(spectrum.vectors.col(k));
    const double residual = (laplacian.L * spectrum.vectors.col(k) - right).norm() / right.norm();
    if (!(residual <= greatest)) greatest = residual;  // written so that NaN becomes the greatest
  }
  return greatest;
}

void checkNumbers(const Path& dir, const Laplacian& laplacian, const Spectrum& spectrum) {
  const VectorXd& values = spectrum.values;
  const Eigen::MatrixXd& vectors = spectrum.vectors;
  if (!values.allFinite() || !std::is_sorted(values.begin(), values.end()) || (values.size() > 0 && values[0] < 0))
    io::refuse(dir / "evals.npy", "does not hold finite eigenvalues >= 0 that ascend");
  if (vectors.rows() != laplacian.M.size() || vectors.cols() != values.size())
    io::refuse(dir / "evecs.npy", "is an array of " + std::to_string(vectors.rows()) + " x " +
                                      std::to_string(vectors.cols()) + ", must be " +
                                      std::to_string(laplacian.M.size()) + " x " + std::to_string(values.size()));
  if (!vectors.allFinite()) io::refuse(dir / "evecs.npy", "holds values that are not finite");
}

}  // namespace

Spectrum readSpectrum(const Path& dir, const Laplacian& laplacian) {
  checkSizes("readSpectrum", laplacian);
  const io::ResultFolder folder(dir);
  const Path report_path = folder.reportPath();
  const nlohmann::json& json = folder.report();
  if (json.value("command", nlohmann::json()) != "spectrum")
    io::refuse(report_path, "is no report of `tufted spectrum`");
  const nlohmann::json written = json.value("checksum", nlohmann::json());
  const std::string expected = checksum(laplacian);
  if (written != expected)
    io::refuse(report_path, "is of another Laplacian: its checksum is " +
                                (written.is_string() ? io::quote(written.get<std::string>()) : "missing") +
                                ", must be \"" + expected + "\"");
  Spectrum spectrum;
  const Eigen::MatrixXd values = readArray(folder.pathOf("evals.npy"));
  if (values.cols() != 1) io::refuse(dir / "evals.npy", "is not an array of K values");
  spectrum.values = values.col(0);
  spectrum.vectors = readArray(folder.pathOf("evecs.npy"));
  checkNumbers(dir, laplacian, spectrum);
  const nlohmann::json said = json.value("/report/residual"_json_pointer, nlohmann::json());
  SpectrumReport& report = spectrum.report;
  report.method = "read";
  report.null_space = static_cast<int>(std::count(spectrum.values.begin(), spectrum.values.end(), 0.0));
  report.residual = greatestResidual(laplacian, spectrum);
  // Ten times the residual that was written, because rounding may differ.
  if (!(report.residual <= 10 * (said.is_number() ? said.get<double>() : 0) + 1e-8))
    io::refuse(dir / "evecs.npy", "does not hold the eigenvectors of evals.npy");
  return spectrum;
}

}  // namespace tufted
