#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "base/buffer.h"
#include "base/cover_source.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "cover/edge_lengths.h"
#include "direct/cover_near_flips.h"
#include "direct/radial_cycles.h"
#include "direct/star_areas.h"
#include "direct/star_metric.h"
#include "neighbors/morton.h"
#include "neighbors/run_boxes.h"
#include "stars/stars.h"
#include "tufted/laplacian.h"

// Start here in this folder. src/cover is the reference: Algorithms 1 to 3 of the paper on a whole cover. Here the same
// L and M are made straight from the stars (section 13 of docs/algorithm.md), which halves time and memory: nearly all
// stars agree, so no edge flips around them and weights can be read off. Parts of a cover exist only where stars
// disagree or edges flip. A change of one folder needs the same change of the other: CloudBuild.* in
// tests/pipeline/cloud_build_test.cpp builds clouds both ways and compares L, M and the cover.
namespace tufted {

/// The union of the stars of a cloud, glued with Gluing::star and FaceOrder::angle. measure(), flip() and assemble()
/// are called once each, in this order.
class StarUnion final : public CoverSource {
 public:
  /// Glues the stars (Algorithm 1).
  /// @param disagrees see findDisagreement()
  /// @param size N, the number of the caller's points
  /// @param has_own_areas whether starAreas() will be called
  StarUnion(Stars stars, Buffer<std::uint8_t> disagrees, RankedCloud cloud, int size, bool has_own_areas,
            const Workers& workers);

  /// Measures lengths, cotangents and areas.
  /// @param memory reused
  StarMetric measure(RawBuffer<double> memory, const Workers& workers) const;

  /// Flips edges until all are Delaunay (Algorithm 2).
  FlipCounts flip(const StarMetric& metric, const Workers& workers);

  /// Sets L and M (Algorithm 3).
  /// @param keep_cover whether cover() will be called
  void assemble(const StarMetric& metric, bool keep_cover, const Workers& workers, Laplacian& result);

  /// The whole cover, made at the first call.
  const IntrinsicTriangulation& cover() const override;
  int vertices() const override { return size_; }
  std::int64_t parts() const override { return stars_.size(); }
  void visitFaces(std::int64_t begin, std::int64_t end, const FaceVisit& visit) const override;
  VectorXd starAreas() const override;
  bool appendFacesNear(const std::vector<Ball>& balls, std::vector<std::array<int, 3>>& faces,
                       std::vector<double>& length) const override;

  /// Mean lengths of the sides of all triangles by component, in units of the ranked points.
  /// @param component see Laplacian::component
  /// @param components number of components
  Buffer<ComponentEdges> componentEdges(const std::vector<int>& component, std::int64_t components,
                                        const Workers& workers) const;

  std::size_t bytes() const { return cover_.bytes(); }

 private:
  /// Appends the faces of a star, with the caller's indices and unit.
  void appendStar(int p, std::vector<std::array<int, 3>>& faces, std::vector<double>& length) const;

  const Stars stars_;
  const Buffer<std::uint8_t> disagrees_;
  const RankedCloud cloud_;
  const int size_, threads_;
  const bool has_own_areas_;
  EdgeLengths length_{cloud_.points};
  RadialCycles cycles_;
  CoverNearFlips cover_;
  mutable std::once_flag once_;
  mutable IntrinsicTriangulation whole_;
  mutable std::once_flag boxes_once_;
  mutable std::optional<RunBoxes> boxes_;  ///< made at the first call of appendFacesNear()
};

}  // namespace tufted
