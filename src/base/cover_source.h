#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/ball.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/types.h"

namespace tufted {

/// What Laplacian::cover() returns, stored or built on demand.
class CoverSource {
 public:
  virtual ~CoverSource() = default;
  /// The tufted cover, built by the first call. May be called from several threads at once.
  virtual const IntrinsicTriangulation& cover() const = 0;
  /// The cover if it is stored, so that it costs nothing to ask for it; otherwise null.
  virtual const IntrinsicTriangulation* stored() const { return nullptr; }
  /// The number of vertices, also without building the cover.
  virtual int vertices() const { return cover().vertices; }
  /// The number of parts in which visitFaces() has the faces: stars of a cloud, otherwise faces.
  virtual std::int64_t parts() const { return cover().size(); }
  using FaceVisit = std::function<void(const std::array<int, 3>& corners, const double* lengths)>;
  /// Visits the faces of some parts, in the order of cover(). Of a cloud it takes them from the stars: the cover would
  /// take about 600 bytes per point.
  /// @param visit gets the corners of a face, and its lengths from each corner to the next one
  virtual void visitFaces(std::int64_t begin, std::int64_t end, const FaceVisit& visit) const {
    const IntrinsicTriangulation& all = cover();
    for (std::int64_t f = begin; f < end; ++f) visit(all.faces[f], all.length.data() + 3 * f);
  }
  /// Mixed areas of points in their own stars: N values in length^2, positive only where the surface ends. There
  /// Mass::star uses them as masses. Size 0 with Mass::cover. Computed anew by each call, with as many threads as the
  /// build had.
  virtual VectorXd starAreas() const { return {}; }
  /// Appends the faces in the stars of all points that lie in some balls, without building the cover. To get every face
  /// of a region, make the balls a little larger than it. A face of several stars is appended several times.
  /// @param balls around positions as in Laplacian::positions, in the caller's unit
  /// @param[in,out] faces gets the three corners of each face, as indices of the caller's points
  /// @param[in,out] length gets three lengths per face, each from a corner to the next one, in the caller's unit
  /// @return false if this source cannot do it; then nothing was appended
  virtual bool appendFacesNear(const std::vector<Ball>& balls, std::vector<std::array<int, 3>>& faces,
                               std::vector<double>& length) const {
    (void)balls, (void)faces, (void)length;
    return false;
  }
};

/// A cover that was built with the matrices, or read from a file. The only source that has one stored, and never made
/// as a constant, so that a later build may take its memory.
struct StoredCover final : CoverSource {
  explicit StoredCover(IntrinsicTriangulation given) : triangulation(std::move(given)) {}
  const IntrinsicTriangulation& cover() const override { return triangulation; }
  const IntrinsicTriangulation* stored() const override { return &triangulation; }

  IntrinsicTriangulation triangulation;
};

}  // namespace tufted
