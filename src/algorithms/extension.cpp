// Extension of scalars (Sharp, Soliman, Crane: "The vector heat method", 2019, Section 4).
#include <string>

#include "algorithms/heat_sources.h"
#include "algorithms/memory_limit.h"
#include "algorithms/vector_heat.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/vector_heat.h"

namespace tufted {
namespace {

constexpr const char* extension_constructor = "ExtensionSolver";
constexpr const char* extension_query = "ExtensionSolver::query";

/// The middle of each column's range, and half its width, or 1 if that is 0. Values are extended relative to these, so
/// that no digits are lost if they are large beside their range.
struct Range {
  Eigen::RowVectorXd middle, half;

  explicit Range(const Eigen::MatrixXd& values) {
    const Eigen::RowVectorXd low = values.colwise().minCoeff() / 2, high = values.colwise().maxCoeff() / 2;
    middle = low + high;
    half = (high - low).unaryExpr([](double range) { return range > 0 ? range : 1; });
  }
};

}  // namespace

struct ExtensionSolver::State {
  FieldHeat heat;
};

ExtensionSolver::ExtensionSolver(const Laplacian& laplacian, const VectorHeatOptions& options)
    : state_(new State{
          FieldHeat(extension_constructor, laplacian, nullptr, options, memoryLimit(options.solver.memory_limit))}) {}

double ExtensionSolver::timeStep() const {
  return state_->heat.timeStep();
}

const SolverReport& ExtensionSolver::report() const {
  return state_->heat.report();
}

Eigen::MatrixXd ExtensionSolver::query(const std::vector<int>& sources, const Eigen::MatrixXd& values,
                                       VectorHeatReport* report, const Progress& progress) const {
  const Stopwatch watch;
  const FieldHeat& heat = state_->heat;
  checkSources(extension_query, sources, "values", values);
  const Range range(values);
  HeatFields start{Eigen::MatrixXd::Zero(heat.size(), 1 + values.cols()), {}};
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const int i = heat.place(extension_query, sources[s]);
    if (i < 0) continue;
    const Eigen::RowVectorXd value = values.row(static_cast<Eigen::Index>(s));
    start.scalars(i, 0) += 1;
    start.scalars.row(i).tail(values.cols()) += (value - range.middle).cwiseQuotient(range.half);
  }
  checkHeat(extension_query, heat, sources, start);
  VectorHeatReport made;
  const HeatFields found = heat.spread(extension_query, start, made, progress);
  Eigen::MatrixXd result = found.scalars.rightCols(values.cols());
  result = (result.array().rowwise() * range.half.array()).rowwise() + range.middle.array();
  heat.copyToCoincident(result);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return result;
}

}  // namespace tufted
