#include "tufted/pcl/surface_values.h"

#include <algorithm>
#include <limits>
#include <string>

#include "tufted/curvature.h"
#include "tufted/errors.h"
#include "tufted/normals.h"
#include "tufted/signatures.h"

namespace tufted::detail {

PointValues normalsAndCurvature(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint, bool curvature,
                                int threads) {
  const Frames frames = orientedFrames(laplacian, {.viewpoint = viewpoint, .threads = threads});
  PointValues values(laplacian.M.size(), 4);
  values.leftCols(3) = frames.normals.cast<float>();
  values.col(3).setConstant(std::numeric_limits<float>::quiet_NaN());
  if (curvature) values.col(3) = curvatures(laplacian, frames, {.threads = threads}).mean.cast<float>();
  return values;
}

PointValues principalCurvatures(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint, int threads) {
  const Frames frames = orientedFrames(laplacian, {.viewpoint = viewpoint, .threads = threads});
  const Curvatures found = curvatures(laplacian, frames, {.threads = threads});
  PointValues values(laplacian.M.size(), 5);
  values << found.first.cast<float>(), found.principal.cast<float>();
  return values;
}

PointValues boundaryKinds(const Laplacian& laplacian) {
  PointValues kinds(laplacian.M.size(), 1);
  for (Eigen::Index i = 0; i < kinds.rows(); ++i) kinds(i, 0) = static_cast<float>(laplacian.boundary[i]);
  return kinds;
}

PointValues signatures(const Laplacian& laplacian, const SignatureSettings& settings, int count,
                       std::vector<double>& samples, int threads) {
  samples = settings.samples;
  if (settings.eigenpairs < 2)
    throw InvalidInput("setEigenpairs: count = " + std::to_string(settings.eigenpairs) + ", must be at least 2");
  if (!samples.empty() && samples.size() != static_cast<std::size_t>(count)) {
    throw InvalidInput("setSamples: " + std::to_string(samples.size()) + " values, must be " + std::to_string(count) +
                       ", one per entry of the output");
  }
  const int count_of_pairs = std::min(settings.eigenpairs, mostEigenpairs(laplacian, false));
  if (count_of_pairs == 0) return PointValues::Zero(laplacian.M.size(), count);  // no point takes part
  const Spectrum pairs = spectrum(laplacian, count_of_pairs, {.null_space = false, .threads = threads});
  const bool is_heat = settings.kind == Signature::heat;
  VectorXd at = Eigen::Map<const VectorXd>(samples.data(), static_cast<Eigen::Index>(samples.size()));
  if (samples.empty()) {
    at = is_heat ? heatTimes(pairs, count) : waveEnergies(pairs, count);
    samples.assign(at.begin(), at.end());
  }
  if (is_heat) return heatKernelSignature(laplacian, pairs, at).cast<float>();
  if (!settings.samples.empty() && (count < 2 || !(at[0] < at[count - 1])))
    throw InvalidInput("setSamples: energies of a wave signature must be at least 2 and ascend");
  // Seven steps wide as by default, and not zero if all eigenvalues are equal.
  const double width = std::max(7 * (at[count - 1] - at[0]) / std::max(1, count - 1), 1e-8);
  return waveKernelSignature(pairs, at, width).cast<float>();
}

}  // namespace tufted::detail
