#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/march_faces.h"

namespace tufted {

/// Positions of sources, by their numbers, in the unit of the faces. Empty: they are not known.
using SourcePositions = std::vector<Eigen::Vector3d>;

/// A vertex whose distance is known at the start.
struct MarchStart {
  int vertex;
  double distance;
  int source;  ///< which source that is the distance from
};

/// What a march over faces of V vertices found; lengths are in the unit of the faces.
struct MarchResult {
  std::vector<double> distance;  ///< of the vertices and then, if faces were split, of the middles of the edges
  std::vector<int> source;       ///< the nearest source, of equally near ones the first; -1: none was reached
  std::int64_t visits = 0;       ///< vertices and middles that were reached, from each source that came near
  std::int64_t lowered = 0;      ///< of these, how many had a distance more than that of a neighbour and their edge
};

/// Marches from the starts over all faces. Distances are the least of those that marches from each source find; see
/// LabelsOfSeveralSources. Where faces have positions none is shorter than the straight line from its source.
/// @param split whether over the four parts of each face, which are not stored
/// @param maximum marches no farther; distances above it may be too large
/// @throws Cancelled when the workers' progress returns false
MarchResult march(const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts, double maximum,
                  const Workers& workers, const SourcePositions& sources = {});

/// Marches from starts of one source, without a maximum, until a vertex has its distance. Those that are nearer have
/// theirs, but for the last step, in which distances are limited by those of neighbours; others may be too large.
MarchResult marchUntil(int vertex, const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts,
                       const Workers& workers);

}  // namespace tufted
