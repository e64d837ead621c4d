#include "direct/star_union.h"

#include <utility>

#include "base/power_of_two.h"
#include "cover/component_edges.h"
#include "cover/face_scale.h"
#include "direct/star_areas.h"
#include "direct/star_rows.h"

namespace tufted {

StarUnion::StarUnion(Stars stars, Buffer<std::uint8_t> disagrees, RankedCloud cloud, int size, bool has_own_areas,
                     const Workers& workers)
    : stars_(std::move(stars)),
      disagrees_(std::move(disagrees)),
      cloud_(std::move(cloud)),
      size_(size),
      threads_(workers.count()),
      has_own_areas_(has_own_areas),
      cycles_(stars_, disagrees_, cloud_.points, workers),
      cover_(stars_, length_, cycles_) {}

StarMetric StarUnion::measure(RawBuffer<double> memory, const Workers& workers) const {
  return measureStars(stars_, length_, std::move(memory), workers);
}

FlipCounts StarUnion::flip(const StarMetric& metric, const Workers& workers) {
  return cover_.flipToDelaunay(metric, workers);
}

void StarUnion::assemble(const StarMetric& metric, bool keep_cover, const Workers& workers, Laplacian& result) {
  if (!keep_cover) {
    cycles_.drop();
    cover_.keepMovedFaces();
  }
  assembleStars({stars_, disagrees_, metric, length_, cover_}, keep_cover, cloud_.input_index, size_,
                faceScale(result.kind), workers, result);
}

const IntrinsicTriangulation& StarUnion::cover() const {
  std::call_once(once_, [this] {
    const Progress silent;
    whole_ = cover_.complete(Workers(threads_, silent));
    toInput(whole_, cloud_.input_index, size_, cloud_.exponent);
  });
  return whole_;
}

void StarUnion::appendStar(int p, std::vector<std::array<int, 3>>& faces, std::vector<double>& length) const {
  const PowerOfTwo unit(cloud_.exponent);
  const std::size_t first_face = faces.size(), first_length = length.size();
  cover_.appendFaces(p, faces, length);
  for (std::size_t f = first_face; f < faces.size(); ++f)
    for (int& corner : faces[f]) corner = cloud_.input_index[corner];
  for (std::size_t i = first_length; i < length.size(); ++i) length[i] = unit.times(length[i]);
}

void StarUnion::visitFaces(std::int64_t begin, std::int64_t end, const FaceVisit& visit) const {
  std::vector<std::array<int, 3>> faces;
  std::vector<double> length;
  for (auto p = static_cast<int>(begin); p < end; ++p) {
    faces.clear();
    length.clear();
    appendStar(p, faces, length);
    for (std::size_t f = 0; f < faces.size(); ++f) visit(faces[f], length.data() + 3 * f);
  }
}

bool StarUnion::appendFacesNear(const std::vector<Ball>& balls, std::vector<std::array<int, 3>>& faces,
                                std::vector<double>& length) const {
  const PowerOfTwo to_ranked(-cloud_.exponent);
  std::vector<Ball> ranked = balls;
  for (Ball& ball : ranked) {
    for (double& coordinate : ball.center) coordinate = to_ranked.times(coordinate);
    ball.radius = to_ranked.times(ball.radius);
  }
  std::call_once(boxes_once_, [this] {
    const Progress silent;
    boxes_.emplace(length_.points, Workers(threads_, silent));
  });
  boxes_->visitBalls(ranked, [&](int p) { appendStar(p, faces, length); });
  return true;
}

Buffer<ComponentEdges> StarUnion::componentEdges(const std::vector<int>& component, std::int64_t components,
                                                 const Workers& workers) const {
  const EdgeLengths lengthOf{cloud_.points};
  return edgesByComponent(
      stars_.size(), components, workers, [&](int p) { return component[cloud_.input_index[p]]; },
      [&](int p, SideSums& sums) {
        for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
          if (!stars_.hasTriangle(i)) continue;
          const int q = stars_.link[i], next = stars_.link[stars_.after(p, i)];
          for (const double side : {lengthOf(p, q), lengthOf(q, next), lengthOf(next, p)}) sums.add(side);
        }
      });
}

VectorXd StarUnion::starAreas() const {
  if (!has_own_areas_) return {};
  const Progress silent;
  const RawBuffer<double> areas = ownAreas(stars_, cloud_.points, Workers(threads_, silent));
  const PowerOfTwo area_unit(2 * cloud_.exponent);
  VectorXd result = VectorXd::Zero(size_);
  for (int p = 0; p < cloud_.size(); ++p) result[cloud_.input_index[p]] = area_unit.times(areas[p]);
  return result;
}

}  // namespace tufted
