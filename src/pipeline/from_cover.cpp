#include "pipeline/from_cover.h"

#include <utility>

#include "cover/assemble.h"
#include "cover/cover.h"
#include "cover/face_scale.h"
#include "pipeline/result.h"

namespace tufted {

void finishFromCover(std::shared_ptr<IntrinsicTriangulation> cover, const CoverVertices& vertices, double delta,
                     bool keep_cover, const Workers& workers, StageClock& clock, Laplacian& result) {
  const double scale = faceScale(result.kind);
  BuildFigures figures{.mean = measureLengths(*cover, vertices.points, vertices.displacement, workers)};
  const Mollification mollified = mollify(*cover, delta * figures.mean.length, workers);
  figures.mollify_length = mollified.length;
  figures.mollify_area = scale * mollified.area;
  figures.triangles = cover->size() / 2;
  clock.finish("lengths", 0);

  figures.flips = flipToDelaunay(*cover, workers);
  clock.finish("flips", 0);

  const int size = static_cast<int>(result.status.size());
  assembleLaplacian(*cover, vertices.input_index, size, scale, workers, result);
  finishResult(figures, vertices.exponent, result);
  if (keep_cover) {
    toInput(*cover, vertices.input_index, size, vertices.exponent);
    result.stored_cover = std::move(cover);
  }
  clock.finish("matrices", bytesOfMatrices(result));
}

}  // namespace tufted
