#include "pipeline/from_cover.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "cover/assemble.h"
#include "cover/component_edges.h"
#include "cover/cover.h"
#include "cover/edge_lengths.h"
#include "cover/face_scale.h"
#include "cover/geometry.h"
#include "cover/short_edges.h"
#include "pipeline/result.h"

namespace tufted {
namespace {

/// Length, in mean edge lengths, that is added to all edges if flips do not end: only random coordinates of all
/// magnitudes needed it.
constexpr double all_edges = 1e-5;
/// Greatest number of rounds of lengthening and flips; mostly one suffices.
constexpr int most_rounds = 8;

/// The sum of value(f) for f in [0, size), with the same bits for any number of threads.
template <class Value>
double sumOfBlocks(std::int64_t size, const Workers& workers, const Value& value) {
  Buffer<double> sums(static_cast<std::size_t>((size + cheap_block - 1) / cheap_block));
  workers.forBlocks("lengths", size, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    double sum = 0;
    for (std::int64_t f = begin; f < end; ++f) sum += value(static_cast<int>(f));
    sums[begin / cheap_block] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// The area of all faces by the positions of their corners, which is accurate for thin triangles too.
double trianglesArea(const IntrinsicTriangulation& cover, const EdgeLengths& length, const Workers& workers) {
  return sumOfBlocks(cover.size(), workers, [&](int f) {
    const auto [ux, uy, uz] = length.offset(cover.faces[f][1], cover.faces[f][0]);
    const auto [vx, vy, vz] = length.offset(cover.faces[f][2], cover.faces[f][0]);
    return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  });
}

/// Sums over the sides of each triangle, before lengthening and flips.
Buffer<SideSums> sidesOfTriangles(const IntrinsicTriangulation& cover, const Workers& workers) {
  Buffer<SideSums> sides(cover.size() / 2);
  workers.forBlocks("lengths", std::ssize(sides), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto t = static_cast<int>(begin); t < end; ++t)
      for (int s = 0; s < 3; ++s) sides[t].add(cover.length[frontSide(t, s)]);
  });
  return sides;
}

}  // namespace

void finishFromCover(std::shared_ptr<StoredCover> stored, const CoverVertices& vertices, double delta, bool keep_cover,
                     const Workers& workers, StageClock& clock, Laplacian& result) {
  IntrinsicTriangulation& cover = stored->triangulation;
  const double scale = faceScale(result.kind);
  BuildFigures figures{.mean = measureLengths(cover, vertices.points, workers)};
  const Buffer<SideSums> sides = sidesOfTriangles(cover, workers);
  figures.triangles = cover.size() / 2;
  const EdgeLengths lengths{vertices.points};
  const double area = trianglesArea(cover, lengths, workers);
  clock.finish("lengths", 0);

  // Flips remove most flat faces of a thin mesh; only those that remain are lengthened, then flipped again.
  figures.flips = flipThinFaces(cover, lengths, delta, figures.lengthened_edges, workers);
  for (int round = 0; round < most_rounds; ++round) {
    const std::int64_t lengthened =
        delta > 0 ? lengthenShortEdges(cover, delta, workers) + lengthenAtFlatFaces(cover, workers) : 0;
    if (round > 0 && lengthened == 0) break;
    figures.lengthened_edges += lengthened;
    const FlipCounts counts = flipToDelaunay(cover, workers);
    figures.flips = {figures.flips.flips + counts.flips, counts.failures};
  }
  // If lengths are equal but for rounding, flips may go in circles. The paper's one length for all edges ends that, at
  // the cost of area, of which the report warns.
  if (delta > 0 && figures.flips.failures > 0) {
    for (double& length : cover.length) length += all_edges * figures.mean.length;
    figures.lengthened_edges = std::ssize(cover.length) / 2;
    const FlipCounts counts = flipToDelaunay(cover, workers);
    figures.flips = {figures.flips.flips + counts.flips, counts.failures};
  }
  figures.area_added = scale * (sumOfBlocks(cover.size(), workers, [&](int f) { return faceArea(cover, f); }) - area);
  clock.finish("flips", 0);

  const int size = static_cast<int>(result.status.size());
  assembleLaplacian(cover, vertices.input_index, size, scale, workers, result);
  if (result.report.components > 1) {
    // Flips move triangles only within their component. A corner may have none.
    const auto componentOf = [&](int t) {
      int component = -1;
      for (const int corner : cover.faces[2 * t])
        component = std::max(component, result.component[vertices.input_index[corner]]);
      return component;
    };
    figures.by_component = edgesByComponent(std::ssize(sides), result.report.components, workers, componentOf,
                                            [&](int t, SideSums& sums) { sums.add(sides[t]); });
  }
  finishResult(figures, vertices.exponent, result);
  if (keep_cover) {
    toInput(cover, vertices.input_index, size, vertices.exponent);
    result.cover_source = std::move(stored);
  }
  clock.finish("matrices", bytesOfMatrices(result));
}

}  // namespace tufted
