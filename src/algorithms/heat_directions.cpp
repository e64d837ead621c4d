// Step 2 of the heat method (Crane, Weischedel, Wardetzky 2013, 2017): the normalised gradient of heat, and its
// divergence.
#include "algorithms/heat_directions.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"

namespace tufted {
namespace {

/// Faces whose direction is still unknown: those that are not `still`, in components with heat.
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
  VectorXd result = VectorXd::Zero(heat.size());
  const auto rounds = makeHeatRounds(function, problem, heat, progress, report);
  while (!waiting.empty() && rounds->next()) {
    const VectorXd& log_u = rounds->logHeat();
    const double valid = rounds->logValid();
    const auto isKnown = [&](const SurfaceFace& face) {
      return std::min({log_u[face.corners[0]], log_u[face.corners[1]], log_u[face.corners[2]]}) >= valid;
    };
    const auto count = static_cast<std::int64_t>(waiting.size());
    workers.forBlocks("directions", count, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (auto k = begin; k < end; ++k) {
        const SurfaceFace& face = problem.surface.faces[waiting[k]];
        const auto& [a, b, c] = face.corners;
        if (isKnown(face)) outflow[k] = divergence(face, -gradientDirection(face, log_u[a], log_u[b], log_u[c]));
      }
    });
    // Sums run in the order of the faces, so that the number of threads does not matter.
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
