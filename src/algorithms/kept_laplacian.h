#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// A copy of what solvers read after their construction: the matrices, and what is known of each point and component.
/// It has neither cover nor frames, positions or report.
inline Laplacian keptLaplacian(const Laplacian& laplacian) {
  Laplacian kept;
  kept.kind = laplacian.kind;
  kept.L = laplacian.L;
  kept.M = laplacian.M;
  kept.status = laplacian.status;
  kept.representative = laplacian.representative;
  kept.boundary = laplacian.boundary;
  kept.component = laplacian.component;
  kept.component_edges = laplacian.component_edges;
  return kept;
}

}  // namespace tufted
