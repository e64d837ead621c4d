// Heat of scalars and vectors, in rounds (Sharp, Soliman, Crane: "The vector heat method", 2019, Sections 3 to 6).
#include "algorithms/vector_heat.h"

#include <algorithm>
#include <cmath>

#include "algorithms/check_positions.h"
#include "algorithms/connection.h"
#include "algorithms/greater.h"
#include "algorithms/heat_time.h"
#include "base/number_text.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Heat is used down to this part of the largest: with a factor half the exponents of a double, as squares are taken;
/// with conjugate gradients six digits above their tolerance, which is relative to the largest.
constexpr double front_of_factor = 1e-150, front_of_iterations = 1e-6;
/// The part of the memory for the factor of scalars; that of vectors has four times as many entries.
constexpr double scalar_share = 0.2;

/// The root mean squared distance of neighbours in L on each component; 1 if there are none.
VectorXd spacingsOf(const SparseMatrix& L, const Points& positions, const Components& components) {
  const auto forEdges = [&](const auto& visit) {
    for (const int j : components.points)
      for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry)
        if (entry.row() < j && entry.value() < 0)
          visit(components.of[j], (positions.row(entry.row()) - positions.row(j)).stableNorm());
  };
  VectorXd longest = VectorXd::Zero(components.count), sum = longest, count = longest;
  forEdges([&](int c, double length) { longest[c] = std::max(longest[c], length); });
  forEdges([&](int c, double length) {
    const double scaled = longest[c] > 0 ? std::ldexp(length, -std::ilogb(longest[c])) : 0;
    sum[c] += scaled * scaled;
    count[c] += 1;
  });
  VectorXd spacing = VectorXd::Ones(components.count);
  for (int c = 0; c < components.count; ++c)
    if (longest[c] > 0) spacing[c] = std::ldexp(std::sqrt(sum[c] / count[c]), std::ilogb(longest[c]));
  return spacing;
}

/// A matrix plus mass on its diagonal, where each point has `width` rows.
// NOLINTNEXTLINE(performance-unnecessary-value-param): changed through iterators
SparseMatrix withMass(SparseMatrix sum, const VectorXd& mass, int width) {
  for (int i = 0; i < sum.outerSize(); ++i) {
    for (SparseMatrix::InnerIterator entry(sum, i); entry; ++entry)
      if (entry.row() == i) entry.valueRef() += mass[i / width];
  }
  return sum;
}

}  // namespace

FieldHeat::FieldHeat(const char* function, const Laplacian& laplacian, const Frames* frames,
                     const VectorHeatOptions& options, std::size_t memory_limit) {
  checkPositions(function, laplacian);
  checkHeatTime(function, options.time_step);
  const Stopwatch watch;
  L_ = laplacian.L;
  components_ = findComponents(laplacian);
  representative_ = laplacian.representative;
  status_ = laplacian.status;
  spacing_ = spacingsOf(L_, laplacian.positions, components_);
  const int largest = components_.largest();
  if (largest >= 0) time_ = options.time_step * spacing_[largest] * spacing_[largest];
  mass_ = least_mass * L_.diagonal();
  for (const int i : components_.points)
    mass_[i] = std::max(laplacian.M[i] / spacingAt(i) / spacingAt(i) / options.time_step, mass_[i]);
  SolverOptions solver = options.solver;
  solver.tolerance = std::min(solver.tolerance, heat_tolerance);
  const auto system = [&](const SparseMatrix& A, const char* matrix, int width, double share) {
    solver.memory_limit = std::max<std::size_t>(static_cast<std::size_t>(share * static_cast<double>(memory_limit)), 1);
    return LinearSystem::positiveDefinite({.function = function, .matrix = matrix}, withMass(A, mass_, width), solver);
  };
  scalars_.emplace(system(L_, "M + t L", 1, frames != nullptr ? scalar_share : 1));
  addReport(scalars_->report(), report_);
  if (frames != nullptr) {
    connection_ = connectionLaplacian(L_, *frames);
    vectors_.emplace(system(connection_, "M + t L of vectors", 2, 1 - scalar_share));
    addReport(vectors_->report(), report_);
  }
  report_.components = components_.count;
  report_.seconds = watch.seconds();
}

int FieldHeat::place(const char* function, int source) const {
  if (source < 0 || source >= size())
    throw InvalidInput(std::string(function) + ": source " + std::to_string(source) + ", must lie in [0, " +
                       std::to_string(size()) + ")");
  const int i = representative_[source];
  return components_.of[i] < 0 ? -1 : i;
}

std::string FieldHeat::whyIgnored(int source) const {
  return whyOnNone("source", source, status_[representative_[source]]);
}

HeatFields FieldHeat::solve(const char* function, HeatFields flow, const std::vector<std::uint8_t>& passed,
                            VectorHeatReport& report, const Progress& progress) const {
  // Scales each component to the same size for iterations, scalars by their first column.
  VectorXd top = VectorXd::Zero(components_.count);
  for (const int i : components_.points) top[components_.of[i]] = std::max(top[components_.of[i]], flow.scalars(i, 0));
  for (const int i : components_.points)
    if (top[components_.of[i]] > 0) flow.scalars.row(i) /= top[components_.of[i]];
  for (Eigen::Index c = 0; c < flow.vectors.cols(); ++c) {
    top.setZero();
    for (const int i : components_.points)
      top[components_.of[i]] = std::max(top[components_.of[i]], flow.vectors.col(c).segment<2>(2 * i).norm());
    for (const int i : components_.points)
      if (top[components_.of[i]] > 0) flow.vectors.col(c).segment<2>(2 * i) /= top[components_.of[i]];
  }
  const bool starts = report.rounds == 1;
  const auto solveWith = [&](const LinearSystem& system, Eigen::MatrixXd& fields) {
    // In later rounds the solution behind the front is only rounding; checkAhead() measures them ahead of it.
    const Refine refine = starts || report_.iterative ? Refine::where_needed : Refine::never;
    SolveReport solved;
    fields = system.solve(function, fields, &solved, progress, refine);
    report.iterations = std::max(report.iterations, solved.iterations);
    report.residual = greater(report.residual, solved.residual);
    report.backward_error = greater(report.backward_error, solved.backward_error);
  };
  const HeatFields right = starts || report_.iterative ? HeatFields{} : flow;
  solveWith(*scalars_, flow.scalars);
  if (flow.vectors.cols() > 0) solveWith(*vectors_, flow.vectors);
  if (right.scalars.cols() > 0) checkAhead(function, right, passed, flow, report);
  return flow;
}

void FieldHeat::checkAhead(const char* function, const HeatFields& right, const std::vector<std::uint8_t>& passed,
                           HeatFields& heat, VectorHeatReport& report) const {
  double error = 0;
  const auto check = [&](const SparseMatrix& A, int width, const Eigen::MatrixXd& b, Eigen::MatrixXd& x) {
    for (const int i : components_.points)
      if (passed[i] != 0) x.middleRows(Eigen::Index{width} * i, width).setZero();
    const double small = front_of_factor * x.cwiseAbs().maxCoeff();
    for (const int i : components_.points) {
      if (passed[i] != 0) continue;
      for (Eigen::Index row = Eigen::Index{width} * i; row < Eigen::Index{width} * (i + 1); ++row) {
        for (Eigen::Index c = 0; c < x.cols(); ++c) {
          double rest = b(row, c) - mass_[i] * x(row, c), size = std::abs(b(row, c)) + mass_[i] * std::abs(x(row, c));
          for (SparseMatrix::InnerIterator entry(A, row); entry; ++entry) {
            rest -= entry.value() * x(entry.row(), c);
            size += std::abs(entry.value() * x(entry.row(), c));
          }
          if (size > small) error = greater(error, std::abs(rest) / size);
        }
      }
    }
  };
  check(L_, 1, right.scalars, heat.scalars);
  if (heat.vectors.cols() > 0) check(connection_, 2, right.vectors, heat.vectors);
  report.backward_error = greater(report.backward_error, error);
  if (error <= most_backward_error) return;
  throw SolverFailure(std::string(function) + ": the backward error |b - A x| / (|A| |x| + |b|) of round " +
                      std::to_string(report.rounds) + " is " + numberText(error) + ", must be " +
                      numberText(most_backward_error) + "; raise the time step");
}

HeatFields FieldHeat::flowAhead(const HeatFields& heat, const std::vector<std::uint8_t>& passed) const {
  HeatFields flow{Eigen::MatrixXd::Zero(heat.scalars.rows(), heat.scalars.cols()),
                  Eigen::MatrixXd::Zero(heat.vectors.rows(), heat.vectors.cols())};
  // This is A (chi u) with chi = 1 ahead of the front and 0 behind, which is 0 except on both sides of the front.
  const auto add = [&](const SparseMatrix& A, int width, int row, const Eigen::MatrixXd& u, Eigen::MatrixXd& b) {
    const bool behind = passed[row / width] != 0;
    for (SparseMatrix::InnerIterator entry(A, row); entry; ++entry) {
      const bool other_behind = passed[entry.row() / width] != 0;
      if (behind != other_behind) b.row(row) += (behind ? 1 : -1) * entry.value() * u.row(entry.row());
    }
  };
  for (const int i : components_.points) {
    add(L_, 1, i, heat.scalars, flow.scalars);
    if (flow.vectors.cols() == 0) continue;
    add(connection_, 2, 2 * i, heat.vectors, flow.vectors);
    add(connection_, 2, 2 * i + 1, heat.vectors, flow.vectors);
  }
  return flow;
}

HeatFields FieldHeat::spread(const char* function, const HeatFields& sources, VectorHeatReport& report,
                             const Progress& progress) const {
  const double front = report_.iterative ? front_of_iterations : front_of_factor;
  HeatFields result{Eigen::MatrixXd::Constant(sources.scalars.rows(), sources.scalars.cols(), std::nan("")),
                    Eigen::MatrixXd::Constant(sources.vectors.rows(), sources.vectors.cols(), std::nan(""))};
  std::vector<std::uint8_t> passed(size(), 0);
  HeatFields flow = sources;
  for (bool flows = true; flows;) {
    ++report.rounds;
    const HeatFields heat = solve(function, std::move(flow), passed, report, progress);
    VectorXd top = VectorXd::Zero(components_.count);
    for (const int i : components_.points)
      top[components_.of[i]] = std::max(top[components_.of[i]], heat.scalars(i, 0));
    bool advanced = false;
    for (const int i : components_.points) {
      const double here = heat.scalars(i, 0);
      if (passed[i] != 0 || !(here > 0 && here >= front * top[components_.of[i]])) continue;
      passed[i] = 1;
      advanced = true;
      result.scalars.row(i) = heat.scalars.row(i) / here;
      for (Eigen::Index c = 0; c < heat.vectors.cols(); ++c)
        result.vectors.col(c).segment<2>(2 * i) = heat.vectors.col(c).segment<2>(2 * i).stableNormalized();
    }
    if (!advanced) break;
    flow = flowAhead(heat, passed);
    flows = (flow.scalars.col(0).array() > 0).any();
  }
  return result;
}

}  // namespace tufted
