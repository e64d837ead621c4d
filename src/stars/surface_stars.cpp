#include "stars/surface_stars.h"

#include "base/stage_clock.h"
#include "stars/agreement.h"
#include "stars/outliers.h"
#include "stars/star_filter.h"

namespace tufted {

SurfaceStars surfaceStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                          const Workers& workers, Report& report) {
  SurfaceStars result{buildStars(cloud, source, options, workers, report), {}};  // books its own stages
  StageClock clock(report);
  const bool is_whole = source.isWholeCloud(cloud.size());
  if (options.steps.isolate_outliers && !is_whole) isolateOutliers(result, cloud, source, workers, report);
  clock.finish("outliers", 0);
  if (!is_whole) filterStars(result, cloud.points, options.steps.filter, workers, report);
  result.disagrees = findDisagreement(result.stars, workers);
  countVotes(result.stars, result.disagrees, workers, report);
  clock.finish("filter", 0);
  return result;
}

}  // namespace tufted
