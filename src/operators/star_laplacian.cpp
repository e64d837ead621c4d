#include "operators/star_laplacian.h"

#include <mutex>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "intrinsic/partial_cover.h"
#include "intrinsic/star_areas.h"
#include "operators/face_scale.h"
#include "operators/star_rows.h"

namespace tufted {
namespace {

/// Of the cover: each triangle has two faces, of which one counts a sixth.
double sumAreas(const StarMetric& metric) {
  return std::accumulate(metric.area.begin(), metric.area.end(), 0.0) / 3;
}

/// The stars and all that was found out about them.
class StarUnion final : public CoverSource {
 public:
  StarUnion(Stars stars, RankedCloud cloud, int size, bool has_own_areas, const Workers& workers)
      : stars_(std::move(stars)),
        cloud_(std::move(cloud)),
        size_(size),
        threads_(workers.count()),
        has_own_areas_(has_own_areas),
        pools_(stars_, cloud_.points, workers),
        cover_(stars_, length_, pools_) {}

  /// Lengths, mollified (Section 4.5).
  /// @param[out] own if given, ownAreas()
  StarMetric measure(double delta, RawBuffer<double> memory, const Workers& workers, OwnAreas* own) {
    StarAreas areas;
    StarMetric metric = measureStars(stars_, length_, std::move(memory), workers, own != nullptr ? &areas : nullptr);
    if (own != nullptr) *own = chooseAreas(stars_, std::move(areas), workers);
    const double missing = delta * metric.mean.length - metric.least_slack;
    if (!(missing > 0)) return metric;
    length_.added = missing;
    const MeanLengths mean = metric.mean;
    const double area = sumAreas(metric);
    metric = measureStars(stars_, length_, std::move(metric.cotan_sum), workers);
    metric.mean = mean;
    mollify_area_ = sumAreas(metric) - area;
    return metric;
  }

  FlipCounts flip(const StarMetric& metric, const Workers& workers) { return cover_.flipToDelaunay(metric, workers); }

  /// @param keep_cover whether cover() will be asked for
  void assemble(const StarMetric& metric, bool keep_cover, const Workers& workers, Laplacian& result) {
    if (!keep_cover) {
      pools_.drop();
      cover_.keepMovedFaces();
    }
    assembleStars({stars_, metric, length_, cover_}, keep_cover, cloud_.caller, size_, faceScale(result.kind), workers,
                  result);
  }

  const IntrinsicTriangulation& cover() const override {
    std::call_once(once_, [this] {
      const Progress silent;
      whole_ = cover_.complete(Workers(threads_, silent));
      toCaller(whole_, cloud_.caller, size_, cloud_.exponent);
    });
    return whole_;
  }

  VectorXd starAreas() const override {
    if (!has_own_areas_) return {};
    const Progress silent;
    const RawBuffer<double> areas = ownAreas(stars_, cloud_.points, Workers(threads_, silent)).area;
    const PowerOfTwo area_unit(2 * cloud_.exponent);
    VectorXd result = VectorXd::Zero(size_);
    for (int p = 0; p < cloud_.size(); ++p) result[cloud_.caller[p]] = area_unit.times(areas[p]);
    return result;
  }

  double mollifyLength() const { return length_.added; }
  /// What it has added to the area of the cover.
  double mollifyArea() const { return mollify_area_; }
  std::size_t bytes() const { return cover_.bytes(); }

 private:
  const Stars stars_;
  const RankedCloud cloud_;
  const int size_, threads_;
  const bool has_own_areas_;
  EdgeLengths length_{cloud_.points, stars_.move};
  double mollify_area_ = 0;
  StarPools pools_;
  PartialCover cover_;
  mutable std::once_flag once_;
  mutable IntrinsicTriangulation whole_;
};

}  // namespace

OwnAreas finishFromStars(Stars stars, RankedCloud cloud, const CloudOptions& options, const Workers& workers,
                         StageClock& clock, Laplacian& result) {
  const int exponent = cloud.exponent;
  RawBuffer<double> memory = std::move(stars.radius);
  BuildFigures figures{.triangles = stars.triangles()};
  const bool has_own_areas = options.steps.mass == Mass::star;
  const auto stars_and_cover =
      std::allocate_shared<StarUnion>(WorkspaceAllocator<StarUnion>(), std::move(stars), std::move(cloud),
                                      static_cast<int>(result.status.size()), has_own_areas, workers);
  clock.finish("cover", 0);

  OwnAreas own;
  const StarMetric metric =
      stars_and_cover->measure(options.mollify, std::move(memory), workers, has_own_areas ? &own : nullptr);
  figures.mean = metric.mean;
  figures.mollify_length = stars_and_cover->mollifyLength();
  figures.mollify_area = stars_and_cover->mollifyArea();
  clock.finish("lengths", bytesOf(metric.cotan_sum) + bytesOf(metric.area));

  figures.flips = stars_and_cover->flip(metric, workers);
  clock.finish("flips", stars_and_cover->bytes());

  stars_and_cover->assemble(metric, options.keep_cover, workers, result);
  finishResult(figures, exponent, result);
  if (options.keep_cover) result.cover_source = stars_and_cover;
  clock.finish("matrices", bytesOfMatrices(result));
  return own;
}

}  // namespace tufted
