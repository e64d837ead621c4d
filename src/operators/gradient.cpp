// Gradients at points by least squares in tangent planes (DiffusionNet; Sharp et al. 2022, Section 3.4), with a
// constant in the fit, and their adjoint.
#include "tufted/gradient.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "operators/slope_fit.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Default number of neighbours on clouds, as in DiffusionNet: with fewer, noise causes larger errors; with more,
/// curvature does.
constexpr int cloud_neighbors = 30;
/// Largest number of neighbours that is accepted; with more, one point would take as long as a small cloud.
constexpr int most_neighbors = 10'000;

void checkArguments(const Laplacian& laplacian, const PointsRef& points, const Frames& frames,
                    const GradientOptions& options) {
  checkSizes("gradients", laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto check = [&](const char* name, Eigen::Index rows) {
    if (rows != n) {
      throw InvalidInput("gradients: " + std::string(name) + " has " + std::to_string(rows) + " rows, must have " +
                         std::to_string(n) + ", one per point of the Laplacian");
    }
  };
  check("points", points.rows());
  check("frames.normals", frames.normals.rows());
  check("frames.tangents", frames.tangents.rows());
  const int neighbors = options.neighbors.value_or(0);
  if (neighbors != 0 && (neighbors < 3 || neighbors > most_neighbors))
    throw InvalidInput("gradients: neighbors = " + std::to_string(neighbors) + ", must be 0 or in [3, " +
                       std::to_string(most_neighbors) + "]");
  if (!(options.regularization >= 0) || !std::isfinite(options.regularization))
    throw InvalidInput("gradients: regularization = " + std::to_string(options.regularization) +
                       ", must be finite and >= 0");
  if (options.threads < 0)
    throw InvalidInput("gradients: threads = " + std::to_string(options.threads) + ", must be >= 0");
}

/// Rows of both gradient matrices, stored one after another.
struct Rows {
  std::vector<int> lengths;  ///< number of entries of each row
  std::vector<int> columns;  ///< ascending in each row
  std::vector<double> x, y;

  void add(const SlopeFit& fit) {
    lengths.push_back(static_cast<int>(fit.points.size()));
    columns.insert(columns.end(), fit.points.begin(), fit.points.end());
    for (Eigen::Index k = 0; k < std::ssize(fit.points); ++k) {
      x.push_back(fit.coefficients(0, k));
      y.push_back(fit.coefficients(1, k));
    }
  }
  void append(const Rows& next) {
    lengths.insert(lengths.end(), next.lengths.begin(), next.lengths.end());
    columns.insert(columns.end(), next.columns.begin(), next.columns.end());
    x.insert(x.end(), next.x.begin(), next.x.end());
    y.insert(y.end(), next.y.begin(), next.y.end());
  }
};

/// The matrix whose row i has the values of row sources[i].
SparseMatrix matrixOf(const Rows& rows, const std::vector<int>& sources, const std::vector<double>& values) {
  const auto n = static_cast<int>(sources.size());
  std::vector<std::int64_t> starts(sources.size() + 1, 0);
  for (int i = 0; i < n; ++i) starts[i + 1] = starts[i] + rows.lengths[i];
  std::int64_t count = 0;
  for (const int source : sources) count += rows.lengths[source];
  requireAtMost(std::numeric_limits<int>::max(), count, "gradients", "entries");
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(n, n);
  matrix.reserve(count);
  for (int i = 0; i < n; ++i) {
    matrix.startVec(i);
    for (std::int64_t k = starts[sources[i]]; k < starts[sources[i] + 1]; ++k)
      matrix.insertBack(i, rows.columns[k]) = values[k];
  }
  matrix.finalize();
  return matrix;
}

/// @param planes given: slopes are measured in the planes of `frames`; fitted: in the planes that fit best
Gradients fitGradients(const Laplacian& laplacian, const PointsRef& points, const Frames& frames, Planes planes,
                       const GradientOptions& options) {
  checkArguments(laplacian, points, frames, options);
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  const auto n = static_cast<int>(laplacian.status.size());
  const SlopeOptions fits = {
      .neighbors = options.neighbors.value_or(laplacian.kind == Kind::cloud ? cloud_neighbors : 0),
      .regularization = options.regularization,
      .planes = planes};
  std::vector<SlopeFitter> fitters;
  fitters.reserve(static_cast<std::size_t>(workers.count()));
  for (int worker = 0; worker < workers.count(); ++worker) fitters.emplace_back(laplacian.L, points, frames, fits);
  Gradients result{SparseMatrix(n, n), SparseMatrix(n, n), frames, {}};
  const auto has_surface = [&](int i) {
    return laplacian.representative[i] == i && laplacian.status[i] == PointStatus::active;
  };
  std::vector<Rows> blocks((static_cast<std::size_t>(n) + costly_block - 1) / costly_block);
  std::vector<GradientReport> reports(blocks.size());
  workers.forBlocks("gradients", n, costly_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    Rows& rows = blocks[begin / costly_block];
    GradientReport& report = reports[begin / costly_block];
    for (int i = static_cast<int>(begin); i < end; ++i) {
      if (!has_surface(i)) {
        rows.lengths.push_back(0);
        continue;
      }
      const SlopeFit& fit = fitters[worker].fit(i);
      result.frames.normals.row(i) = fit.normal;
      result.frames.tangents.row(i) = fit.tangent;
      report.widened += fit.is_widened;
      report.on_a_line += fit.is_on_a_line;
      report.mean_neighbors += static_cast<double>(fit.points.size()) - 1;
      rows.add(fit);
    }
  });
  Rows all;
  for (Rows& block : blocks) {
    all.append(block);
    block = {};
  }
  std::int64_t active = 0;
  for (int i = 0; i < n; ++i) {
    const int source = laplacian.representative[i];
    active += has_surface(i);
    const bool is_on_surface = laplacian.status[source] == PointStatus::active;
    result.frames.normals.row(i) =
        is_on_surface ? Eigen::RowVector3d(result.frames.normals.row(source)) : Eigen::RowVector3d::UnitZ();
    result.frames.tangents.row(i) =
        is_on_surface ? Eigen::RowVector3d(result.frames.tangents.row(source)) : Eigen::RowVector3d::UnitX();
  }
  result.X = matrixOf(all, laplacian.representative, all.x);
  result.Y = matrixOf(all, laplacian.representative, all.y);
  for (const GradientReport& report : reports) {
    result.report.widened += report.widened;
    result.report.on_a_line += report.on_a_line;
    result.report.mean_neighbors += report.mean_neighbors;
  }
  if (active > 0) result.report.mean_neighbors /= static_cast<double>(active);
  result.report.seconds = watch.seconds();
  return result;
}

}  // namespace

Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const GradientOptions& options) {
  checkSizes("gradients", laplacian);
  if (laplacian.frames.normals.rows() == 0 && !laplacian.status.empty()) {
    throw InvalidInput("gradients: the Laplacian has no frames, must be that of a cloud; meshes have meshFrames()");
  }
  return fitGradients(laplacian, points, laplacian.frames, Planes::fitted, options);
}

Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const Frames& frames,
                    const GradientOptions& options) {
  return fitGradients(laplacian, points, frames, Planes::given, options);
}

VectorXd divergence(const Laplacian& laplacian, const Gradients& gradients,
                    const Eigen::Ref<const Eigen::MatrixX2d>& vectors) {
  checkSizes("divergence", laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto check = [n](const char* name, Eigen::Index size) {
    if (size != n)
      throw InvalidInput("divergence: " + std::string(name) + " has " + std::to_string(size) + " rows, must have " +
                         std::to_string(n) + ", one per point of the Laplacian");
  };
  check("gradients.X", gradients.X.rows());
  check("gradients.Y", gradients.Y.rows());
  check("vectors", vectors.rows());
  Eigen::MatrixX2d weighted = Eigen::MatrixX2d::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    if (!vectors.row(i).allFinite())
      throw InvalidInput("divergence: row " + std::to_string(i) + " of vectors is not finite, must be");
    weighted.row(i) = laplacian.M[i] * vectors.row(i);
  }
  VectorXd result = -(gradients.X.transpose() * weighted.col(0) + gradients.Y.transpose() * weighted.col(1)).eval();
  for (Eigen::Index i = 0; i < n; ++i) result[i] = laplacian.M[i] > 0 ? result[i] / laplacian.M[i] : 0;
  for (Eigen::Index i = 0; i < n; ++i) result[i] = result[laplacian.representative[i]];
  return result;
}

}  // namespace tufted
