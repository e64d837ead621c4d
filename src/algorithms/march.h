#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/march_faces.h"

namespace tufted {

/// Positions of sources by number, in the unit of the faces. Empty: not known.
using SourcePositions = std::vector<Eigen::Vector3d>;

/// A vertex whose distance is known at the start.
struct MarchStart {
  int vertex;
  double distance;
  int source;  ///< number of the source that the distance is from
};

/// Result of a march; lengths are in the unit of the faces.
struct MarchResult {
  std::vector<double> distance;  ///< of the vertices, then, if faces were cut, of the midpoints of edges
  std::vector<int> source;   ///< nearest source of each, of equally near ones the first; -1: not reached. Empty if all
                             ///< starts are of one source
  std::int64_t visits = 0;   ///< how often a vertex was frozen
  std::int64_t lowered = 0;  ///< how often a distance exceeded that of a neighbour plus their edge, and was reduced
};

/// Marches from the starts over all faces. Distances from several sources are the least of those from each. If faces
/// have positions, none is below the straight line from its source.
/// @param split whether each face is cut into four, which are not stored
/// @param maximum the march ends there; distances above it may be too large
/// @throws Cancelled when the workers' progress returns false
MarchResult march(const MarchFaces& faces, bool split, std::vector<MarchStart> starts, double maximum,
                  const Workers& workers, const SourcePositions& sources = {});

/// The result of no source on faces that are not cut: infinite distances.
MarchResult unreached(const MarchFaces& faces);

/// Marches from one more source on faces that are not cut, where it may be nearer than the sources in a result, and
/// adds it there.
/// @param sources with the positions of all sources, by number
void marchWhereNearer(const MarchFaces& faces, const std::vector<MarchStart>& starts, const Workers& workers,
                      const SourcePositions& sources, MarchResult& result);

/// Marches from starts of one source until a vertex is frozen. Distances of nearer ones are final except for the last
/// step of march(), which limits them by those of neighbours; others may be too large.
MarchResult marchUntil(int vertex, const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts,
                       const Workers& workers);

}  // namespace tufted
