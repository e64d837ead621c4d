#include "algorithms/heat_directions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/greater.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// u keeps its relative accuracy down to underflow, because in the factor of an M-matrix and with heat >= 0 nothing but
/// numbers of one sign is ever added. Conjugate gradients know no more than their tolerance, `heat_tolerance`.
struct Range {
  double valid;  ///< u is trusted above this part of its component's largest value
  double front;  ///< where it falls below this heat starts again; far enough above `valid` to even out
};
constexpr Range by_elimination = {1e-285, 1e-245};
constexpr Range by_iteration = {1e-9, 1e-5};

/// Heat that starts again and again where it would underflow.
class Rounds {
 public:
  Rounds(const std::string& function, const HeatProblem& problem, const VectorXd& heat, const Progress& progress,
         DistanceReport& report)
      : function_(function),
        problem_(problem),
        progress_(progress),
        range_(isIterative(problem) ? by_iteration : by_elimination),
        heat_(heat),
        passed_(static_cast<std::size_t>(heat.size()), 0),
        report_(report) {}

  /// Finds the heat of the next round; false when it has gone as far as it can.
  bool next() {
    if (report_.rounds > 0 && !restart()) return false;
    ++report_.rounds;
    problem_.components.normalise(heat_);
    u_ = solve(problem_.closed, heat_);
    if (problem_.open != nullptr) u_ = (u_ + solve(*problem_.open, heat_.cwiseProduct(problem_.interior))) / 2;
    problem_.components.normalise(u_);
    return true;
  }

  const VectorXd& u() const { return u_; }
  double valid() const { return range_.valid; }

 private:
  static bool isIterative(const HeatProblem& problem) {
    return problem.closed.report().iterative || (problem.open != nullptr && problem.open->report().iterative);
  }

  VectorXd solve(const LinearSystem& system, const VectorXd& heat) {
    SolveReport solved;
    VectorXd u = system.solve(function_, heat, &solved, progress_);
    report_.iterations = std::max(report_.iterations, solved.iterations);
    report_.residual = greater(report_.residual, solved.residual);
    report_.backward_error = greater(report_.backward_error, solved.backward_error);
    return u;
  }

  /// What flows from points that heat has reached into those that it has not is the heat of the next round. Past the
  /// front the wave is the same as if it had never stopped (Huygens). Returns whether anything flows.
  bool restart() {
    const auto reached = [&](Eigen::Index i) { return u_[i] >= range_.front; };
    bool advanced = false, flows = false;
    for (const int i : problem_.components.points) {
      if (!reached(i) || passed_[i] != 0) continue;
      passed_[i] = 1;
      advanced = true;
    }
    heat_.setZero();
    if (!advanced) return false;
    for (const int i : problem_.components.points) {
      if (passed_[i] != 0) continue;
      for (SparseMatrix::InnerIterator entry(problem_.L, i); entry; ++entry) {
        if (entry.row() != i && reached(entry.row())) heat_[i] -= entry.value() * (u_[entry.row()] / range_.front);
      }
      flows |= heat_[i] > 0;
    }
    return flows;
  }

  const std::string& function_;
  const HeatProblem& problem_;
  const Progress& progress_;
  Range range_;
  VectorXd heat_, u_;
  std::vector<std::uint8_t> passed_;
  DistanceReport& report_;
};

/// Faces that wait for heat: those that are not still, in components that have some.
std::vector<int> waitingFaces(const HeatProblem& problem, const VectorXd& heat,
                              const std::vector<std::uint8_t>& still) {
  const Components& components = problem.components;
  std::vector<std::uint8_t> warm(components.count, 0);
  for (const int i : components.points) warm[components.of[i]] |= heat[i] > 0 ? 1 : 0;
  std::vector<int> waiting;
  for (std::size_t f = 0; f < problem.surface.faces.size(); ++f) {
    const int component = components.of[problem.surface.faces[f].corners[0]];
    if (component >= 0 && warm[component] != 0 && still[f] == 0) waiting.push_back(static_cast<int>(f));
  }
  return waiting;
}

}  // namespace

VectorXd divergenceOfHeat(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                          const std::vector<std::uint8_t>& still, int threads, const Progress& progress,
                          DistanceReport& report) {
  const Workers workers(threads, progress);
  std::vector<int> waiting = waitingFaces(problem, heat, still);
  std::vector<std::array<double, 3>> outflow(waiting.size());
  VectorXd result = VectorXd::Zero(heat.size()), log_u;
  Rounds rounds(function, problem, heat, progress, report);
  while (!waiting.empty() && rounds.next()) {
    log_u = rounds.u().array().max(0).log();  // -infinity where nothing is
    const double valid = std::log(rounds.valid());
    const auto isKnown = [&](const SurfaceFace& face) {
      return std::min({log_u[face.corners[0]], log_u[face.corners[1]], log_u[face.corners[2]]}) >= valid;
    };
    const auto count = static_cast<std::int64_t>(waiting.size());
    workers.forBlocks("directions", count, block_size, [&](std::int64_t begin, std::int64_t end, int) {
      for (auto k = begin; k < end; ++k) {
        const SurfaceFace& face = problem.surface.faces[waiting[k]];
        const auto& [a, b, c] = face.corners;
        if (isKnown(face)) outflow[k] = divergence(face, -gradientDirection(face, log_u[a], log_u[b], log_u[c]));
      }
    });
    // Added in the order of the faces, whatever the number of threads.
    std::size_t kept = 0;
    for (std::int64_t k = 0; k < count; ++k) {
      const SurfaceFace& face = problem.surface.faces[waiting[k]];
      if (!isKnown(face)) {
        waiting[kept++] = waiting[k];
        continue;
      }
      for (int corner = 0; corner < 3; ++corner) result[face.corners[corner]] += outflow[k][corner];
    }
    waiting.resize(kept);
  }
  return result;
}

}  // namespace tufted
