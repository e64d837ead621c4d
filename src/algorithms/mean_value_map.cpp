// Parameterisation by mean value weights (Floater 2003).
#include "algorithms/mean_value_map.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <string>

#include "algorithms/chart_metric.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/sort_unique.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Largest residual that is accepted, as a part of the largest coordinate; rows have sum 1.
constexpr double most_left_over = 1e-10;
/// Number of corrections of the solution.
constexpr int corrections = 2;

}  // namespace

void mapByMeanValues(const char* function, const Points& positions, const Chart& chart,
                     const std::vector<std::uint8_t>& is_pinned, const SolverOptions& options, Eigen::MatrixX2d& uv,
                     ParameterizationReport& report) {
  const Workers workers(options.threads, options.progress);
  workers.report("mean values", 0);
  report.solver_method = "LU (Eigen)";
  std::vector<int> local(is_pinned.size(), -1), free;
  for (const auto& corners : chart.triangles)
    for (const int i : corners)
      if (is_pinned[i] == 0) free.push_back(i);
  sortUnique(free);
  if (free.empty()) return;
  const int n = static_cast<int>(free.size());
  for (int k = 0; k < n; ++k) local[free[k]] = k;
  const int exponent = exponentOf(positions, chart.triangles);

  // Rows are divided by the sum of their weights, so that sizes of triangles do not matter.
  VectorXd sum = VectorXd::Zero(n);
  const auto forWeights = [&](const auto& visit) {
    for (const auto& corners : chart.triangles) {
      const TriangleSides sides = measureTriangle(positions, corners, exponent);
      for (int k = 0; k < 3; ++k) {
        const int i = local[corners[k]];
        if (i < 0) continue;
        const int next = (k + 1) % 3, previous = (k + 2) % 3;
        visit(i, corners[next], sides.half_tan[k] / sides.opposite[previous]);
        visit(i, corners[previous], sides.half_tan[k] / sides.opposite[next]);
      }
    }
  };
  forWeights([&](int i, int, double weight) { sum[i] += weight; });
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(n, 2);
  forWeights([&](int i, int j, double weight) {
    if (local[j] >= 0)
      entries.emplace_back(i, local[j], -weight / sum[i]);
    else
      b.row(i) += weight / sum[i] * uv.row(j);
  });
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1);
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<SparseMatrix> factor(A);
  workers.report("mean values", 0.9);
  if (factor.info() != Eigen::Success)
    throw SolverFailure(std::string(function) + ": the matrix of mean values could not be factorised");
  Eigen::MatrixX2d x = factor.solve(b);
  for (int k = 0; k < corrections; ++k) x += factor.solve(Eigen::MatrixX2d(b - A * x));
  const double size = std::max(x.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  const double left = (b - A * x).cwiseAbs().maxCoeff();
  const double residual = size > 0 ? left / size : left;
  if (!(residual <= most_left_over))
    throw SolverFailure(std::string(function) + ": the residual of the mean values is " + numberText(residual) +
                        ", must be at most " + numberText(most_left_over));
  report.residual = residual;
  for (int k = 0; k < n; ++k) uv.row(free[k]) = x.row(k);
}

}  // namespace tufted
