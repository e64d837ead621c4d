#include "pipeline/from_stars.h"

#include <memory>
#include <utility>

#include "base/buffer.h"
#include "base/workspace.h"
#include "direct/star_union.h"
#include "pipeline/result.h"

namespace tufted {

bool finishFromStars(SurfaceStars built, RankedCloud cloud, const CloudOptions& options, const Workers& workers,
                     StageClock& clock, Laplacian& result) {
  const int exponent = cloud.exponent;
  RawBuffer<double> memory = std::move(built.support.radius);
  BuildFigures figures{.triangles = built.stars.triangles()};
  const auto stars_and_cover = std::allocate_shared<StarUnion>(
      WorkspaceAllocator<StarUnion>(), std::move(built.stars), std::move(built.disagrees), std::move(cloud),
      static_cast<int>(result.status.size()), options.steps.mass == Mass::star, workers);
  clock.finish("cover", 0);

  const StarMetric metric = stars_and_cover->measure(std::move(memory), workers);
  if (metric.has_flat && options.mollify > 0) return false;
  figures.mean = metric.mean;
  clock.finish("lengths", bytesOf(metric.cotan_sum) + bytesOf(metric.area));

  figures.flips = stars_and_cover->flip(metric, workers);
  clock.finish("flips", stars_and_cover->bytes());
  if (figures.flips.failures > 0 && options.mollify > 0) return false;

  stars_and_cover->assemble(metric, options.keep_cover, workers, result);
  if (result.report.degenerate_faces > 0 && options.mollify > 0) return false;  // flips made some faces flat
  if (result.report.components > 1)
    figures.by_component = stars_and_cover->componentEdges(result.component, result.report.components, workers);
  finishResult(figures, exponent, result);
  if (options.keep_cover) result.cover_source = stars_and_cover;
  clock.finish("matrices", bytesOfMatrices(result));
  return true;
}

}  // namespace tufted
