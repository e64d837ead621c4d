#pragma once

#include <cstdint>
#include <memory>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "tufted/laplacian.h"

namespace tufted {

// What the builds of clouds and of meshes do to their results.

/// @throws InvalidInput in the name of `function` unless mollify lies in [0, 1] and threads is at least 0
void checkBuild(const char* function, double mollify, int threads);

/// Empties the result of an earlier build, but for the memory of its arrays and of a stored cover.
void restart(Laplacian& result, Kind kind, std::int64_t points, const Workers& workers);

/// The cover of an earlier build, if nobody else has it, for the sake of its memory; otherwise a new one.
IntrinsicTriangulation takeCover(Laplacian& result);

/// What a build knows beside L and M, in units of the points that it worked on.
struct BuildFigures {
  MeanLengths mean = {};
  std::int64_t lengthened_edges = 0;
  double area_added = 0;
  Buffer<ComponentEdges> by_component = {};  ///< empty: there is one component at most
  FlipCounts flips = {};
  std::int64_t triangles = 0;
};

/// Completes a result that has L and M: masses in the caller's unit, status and boundary of all points, the report.
/// @param exponent the build's unit is 2^exponent of the caller's
void finishResult(const BuildFigures& figures, int exponent, Laplacian& result);

std::size_t bytesOfMatrices(const Laplacian& result);

}  // namespace tufted
