#include "stars/surface_stars.h"

#include <utility>

#include "base/stage_clock.h"
#include "stars/agreement.h"
#include "stars/diagonals.h"
#include "stars/outliers.h"
#include "stars/star_filter.h"

namespace tufted {

SurfaceStars filteredStars(BuiltStars built, bool is_whole_cloud, const PointsView& points, const CloudOptions& options,
                           const Workers& workers, Report& report) {
  SurfaceStars result{std::move(built), {}};
  StageClock clock(report);
  if (!is_whole_cloud) filterStars(result, points, options.steps.filter, workers, report);
  result.disagrees = findDisagreement(result.stars, workers);
  if (options.steps.settle_diagonals) {
    report.settled_diagonals = settleDiagonals(points, result.disagrees, workers, result.stars);
    // A point that agrees is no corner of a changed quadrilateral, so it still agrees.
    if (report.settled_diagonals > 0) result.disagrees = findDisagreement(result.stars, workers, result.disagrees);
  }
  countVotes(result.stars, result.disagrees, workers, report);
  clock.finish("filter", 0);
  return result;
}

SurfaceStars surfaceStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                          const Workers& workers, Report& report) {
  BuiltStars built = buildStars(cloud, source, options, workers, report);  // records its own stages
  StageClock clock(report);
  const bool is_whole_cloud = source.isWholeCloud(cloud.size());
  if (options.steps.isolate_outliers && !is_whole_cloud) isolateOutliers(built, cloud, source, workers, report);
  clock.finish("outliers", 0);
  return filteredStars(std::move(built), is_whole_cloud, cloud.points, options, workers, report);
}

}  // namespace tufted
