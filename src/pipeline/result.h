#pragma once

#include <cstdint>
#include <memory>

#include "base/buffer.h"
#include "base/cover_source.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "tufted/laplacian.h"

namespace tufted {

// Shared by the builds of clouds and of meshes.

/// Checks the options that all builds have.
/// @throws InvalidInput, naming `function`, unless mollify is in [0, 1] and threads is at least 0
void checkBuild(const char* function, double mollify, int threads);

/// Empties a result but keeps the memory of its arrays and of a stored cover.
void restart(Laplacian& result, Kind kind, std::int64_t points, const Workers& workers);

/// The cover of an earlier build for its memory, if nobody else holds it; otherwise a new one.
std::shared_ptr<StoredCover> takeCover(Laplacian& result);

/// Figures of a build besides L and M, in units of the ranked points.
struct BuildFigures {
  MeanLengths mean = {};
  std::int64_t lengthened_edges = 0;
  double area_added = 0;
  Buffer<ComponentEdges> by_component = {};  ///< empty if there is at most one component
  FlipCounts flips = {};
  std::int64_t triangles = 0;
};

/// Completes a result with L and M: masses in the caller's unit, status and boundary of all points, the report.
/// @param exponent the build's unit is 2^exponent of the caller's
void finishResult(const BuildFigures& figures, int exponent, Laplacian& result);

std::size_t bytesOfMatrices(const Laplacian& result);

}  // namespace tufted
