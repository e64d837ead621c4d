#include "bench/star_union.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "pipeline/cloud_surface.h"

namespace tufted::bench {

Triangles unionOfStars(const Points& points, const CloudOptions& options, const Laplacian& laplacian) {
  const Workers workers(options.threads, options.progress);
  std::vector<PointStatus> status;
  std::vector<int> representative;
  Report report;
  RankedCloud cloud = rankPoints(points, status, representative);
  StageClock clock(report);
  const Stars stars =
      findSurface(cloud, options, options.viewpoint, status, representative, workers, clock, report).built.stars;

  Triangles triangles(laplacian.report.triangles, 3);
  Eigen::Index count = 0;
  for (int p = 0; p < stars.size(); ++p) {
    for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
      if (!stars.hasTriangle(i)) continue;
      if (count < triangles.rows()) {
        triangles.row(count) << cloud.input_index[p], cloud.input_index[stars.link[i]],
            cloud.input_index[stars.link[stars.after(p, i)]];
      }
      ++count;
    }
  }
  // The stages above repeat those of pointCloudLaplacian(); fails if they no longer agree.
  if (count != triangles.rows() || report.dropped_triangles != laplacian.report.dropped_triangles) {
    throw std::logic_error("unionOfStars: " + std::to_string(count) + " triangles instead of " +
                           std::to_string(triangles.rows()) + ": no longer follows pointCloudLaplacian");
  }
  return triangles;
}

}  // namespace tufted::bench
