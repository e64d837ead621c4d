// Parallel transport of vectors (Sharp, Soliman, Crane: "The vector heat method", 2019, Algorithm 1).
#include <Eigen/Geometry>
#include <string>

#include "algorithms/check_positions.h"
#include "algorithms/heat_sources.h"
#include "algorithms/memory_limit.h"
#include "algorithms/vector_heat.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/vector_heat.h"

namespace tufted {
namespace {

constexpr const char* transport_constructor = "TransportSolver";
constexpr const char* transport_query = "TransportSolver::query";

}  // namespace

struct TransportSolver::State {
  Frames frames;
  FieldHeat heat;
};

TransportSolver::TransportSolver(const Laplacian& laplacian, const VectorHeatOptions& options)
    : TransportSolver(laplacian, laplacian.frames, options) {}

TransportSolver::TransportSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options) {
  checkFrames(transport_constructor, laplacian, frames);
  state_.reset(new State{
      frames, FieldHeat(transport_constructor, laplacian, &frames, options, memoryLimit(options.solver.memory_limit))});
}

double TransportSolver::timeStep() const {
  return state_->heat.timeStep();
}

const SolverReport& TransportSolver::report() const {
  return state_->heat.report();
}

Points TransportSolver::query(const std::vector<int>& sources, const Points& vectors, VectorHeatReport* report,
                              const Progress& progress) const {
  const Stopwatch watch;
  const FieldHeat& heat = state_->heat;
  checkSources(transport_query, sources, "vectors", vectors);
  const int n = heat.size();
  double longest = 0;  // unit of the lengths that are transported
  for (Eigen::Index s = 0; s < vectors.rows(); ++s) longest = std::max(longest, vectors.row(s).stableNorm());
  const double unit = longest > 0 ? longest : 1;
  HeatFields start{Eigen::MatrixXd::Zero(n, 2), Eigen::MatrixXd::Zero(2 * Eigen::Index{n}, 1)};
  Eigen::VectorXd count = Eigen::VectorXd::Zero(n);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const int i = heat.place(transport_query, sources[s]);
    if (i < 0) continue;
    const std::string name = std::string(transport_query) + ": the vector of source " + std::to_string(sources[s]);
    const Eigen::RowVector3d vector = vectors.row(static_cast<Eigen::Index>(s)) / unit;
    start.vectors.col(0).segment<2>(2 * i) += inTangentPlane(name, state_->frames, i, vector);
    start.scalars(i, 0) += 1;
  }
  checkHeat(transport_query, heat, sources, start);
  for (int i = 0; i < n; ++i) start.scalars(i, 1) = start.vectors.col(0).segment<2>(2 * i).norm();
  VectorHeatReport made;
  const HeatFields found = heat.spread(transport_query, start, made, progress);
  Points result = Points::Zero(n, 3);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d direction = found.vectors.col(0).segment<2>(2 * i);
    if (!direction.allFinite()) continue;
    const Eigen::RowVector3d normal = state_->frames.normals.row(i), x = state_->frames.tangents.row(i);
    result.row(i) = unit * found.scalars(i, 1) * (direction[0] * x + direction[1] * normal.cross(x));
  }
  heat.copyToCoincident(result);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return result;
}

}  // namespace tufted
