#include "denoise/crease_moves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "denoise/crease_model.h"
#include "denoise/pooling.h"
#include "denoise/window_surface.h"
#include "stars/displacements.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr double fade = 0.05;        // of the noise's variance, by which windows with larger residuals count less
constexpr double height_fade = 1.5;  // sigmas, by which windows whose surface is farther away count less
constexpr double most_height = 3;    // sigmas from the best window's surface
constexpr double same_side = 0.95;   // cosine between the normals of windows on one side of a crease
constexpr int rounds = 2;            // of fits through one side
constexpr int widest_lender = 2;     // times the base window
constexpr int one_side = 4;          // times the base window; half of it may be on the other side
constexpr double agreement = 0.9;    // cosine between the normals of points on one side
constexpr int least_on_side = 12;    // twice as many points as coefficients
constexpr double most_step = 2;      // sigmas in one round
constexpr int faces_within = 4;      // times the base window; half of it where that holds more than one crease
constexpr int widest_crossing = 2;   // the widest window that may lie across a crease and take it for a bend
/// Squared radii grow by this, or rounding would decide whether a window holds its last neighbour.
constexpr double widened_radius = 1 + 1e-9;
constexpr double most_way = 5;  // sigmas; of normal noise one point in a million is farther from its face

/// A window that holds p, and how much it counts.
struct Lender {
  double weight;
  WindowSurface surface;
};

/// Memory of one worker.
struct CreaseScratch {
  WindowNeighbors around;
  Buffer<Lender> lenders;
  Buffer<int> side;
  OffsetBuffer offsets;
  CreaseModel model;
};

class CreaseMover {
 public:
  /// All arguments are borrowed.
  CreaseMover(const PointsView& points, const Windows& windows, const NoiseLevel& noise)
      : points_(points), windows_(windows), noise_(noise) {}

  /// A move of p onto the surfaces of windows of one size around its neighbours: of those that explain their points by
  /// noise alone, best first, and lie on the same side of the crease as the best. False where none does.
  bool borrow(int p, int window, CreaseScratch& scratch, Eigen::RowVector3d& move, Eigen::RowVector3d& normal) const {
    const double variance = noise_.variance[p];
    const auto count = std::min<std::ptrdiff_t>(windows_.base[p] / 2 << window, std::ssize(scratch.around.all));
    scratch.lenders.clear();
    const Lender* best = nullptr;
    double best_variance = 0;
    scratch.lenders.reserve(static_cast<std::size_t>(count) + 1);
    for (std::ptrdiff_t i = -1; i < count; ++i) {
      const int q = i < 0 ? p : scratch.around.all[i].index;
      const WindowFit& fit = windows_.fits[q][window];
      const Eigen::Vector3d d = (points_.row(p) - points_.row(q)).transpose();
      if (!std::isfinite(fit.variance) || !(d.squaredNorm() <= widened_radius * fit.radius * fit.radius)) continue;
      const WindowSurface surface = surfaceAt(windows_, q, window, d);
      const double misfit = std::max(fit.variance / variance - 1, 0.0) / fade;
      const double distance = surface.height * surface.height / (2 * height_fade * height_fade * variance);
      scratch.lenders.push_back({std::exp(-misfit - distance), surface});
      if (best != nullptr && !(scratch.lenders.back().weight > best->weight)) continue;
      best = &scratch.lenders.back();
      best_variance = fit.variance;
    }
    if (best == nullptr || !(best_variance < explained * variance)) return false;
    const double height = best->surface.height;
    if (!(height * height < most_height * most_height * variance)) return false;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const Lender& lender : scratch.lenders) {
      if (!(std::abs(lender.surface.normal.dot(best->surface.normal)) > same_side)) continue;
      weights += lender.weight;
      sum -= lender.weight * lender.surface.height * lender.surface.normal;
    }
    move = (sum / weights).transpose();
    normal = best->surface.normal.transpose();
    return true;
  }

  /// The step from where p has moved to onto a fit through the neighbours on its side, where they have moved to. Zero
  /// where these are few, or do not lie on one smooth surface.
  /// @param scratch with the neighbours of p
  Eigen::RowVector3d stepOnSide(int p, const PointBuffer& move, const PointBuffer& normals,
                                CreaseScratch& scratch) const {
    scratch.side.clear();
    for (std::size_t i = 0; i < scratch.around.all.size(); ++i) {
      const int q = scratch.around.all[i].index;
      if (scratch.around.skipped[i] == 0 && noise_.noisy[q] != 0 &&
          std::abs(normals.row(q).dot(normals.row(p))) > agreement)
        scratch.side.push_back(q);
    }
    if (std::ssize(scratch.side) < least_on_side) return Eigen::RowVector3d::Zero();
    const Eigen::Vector3d normal = normals.row(p).transpose();
    std::array<HeightMoments, 2> moments;
    scratch.offsets.fill(static_cast<int>(scratch.side.size()),
                         [&](int i) -> Eigen::RowVector3d { return points_.row(scratch.side[i]) - points_.row(p); });
    moments[0] = heightMoments(scratch.offsets.view(), normal, windows_.radius[p]);
    takeMoved(points_, move, p, scratch.side, scratch.offsets);
    moments[1] = heightMoments(scratch.offsets.view(), normal, windows_.radius[p]);
    std::array<HeightFit, 2> fits;  // through the points as they are, and where they have moved to
    fitHeights(moments, fits);
    const double variance = noise_.variance[p];
    if (!fits[0].is_valid || !fits[1].is_valid || !(fits[0].variance < explained * variance) ||
        !(fits[1].height * fits[1].height < most_step * most_step * variance))
      return Eigen::RowVector3d::Zero();
    return fits[1].height * normal.transpose();
  }

  /// Finds the faces that meet around p.
  /// @param normal(q) of the surface at point q, zero where it is not known
  /// @param scratch with the neighbours of p
  template <class Normal>
  bool findFaces(int p, const Normal& normal, CreaseScratch& scratch) const {
    CreaseModel& model = scratch.model;
    model.start(noise_.variance[p], windows_.radius[p]);
    model.add(Eigen::RowVector3d::Zero(), normal(p));
    for (std::size_t i = 0; i < scratch.around.all.size(); ++i) {
      const int q = scratch.around.all[i].index;
      if (scratch.around.skipped[i] == 0) model.add(points_.row(q) - points_.row(p), normal(q));
    }
    const auto all = static_cast<int>(scratch.around.all.size());
    return model.fit(all) || model.fit(all / 2);  // all may be around more than one crease
  }

  Eigen::RowVector3d normalOf(int p, int window) const {
    return surfaceAt(windows_, p, window, Eigen::Vector3d::Zero()).normal.transpose();
  }

 private:
  PointsView points_;
  const Windows& windows_;
  const NoiseLevel& noise_;
};

/// The normals of the surface around points whose windows lie within one face.
class FaceNormals {
 public:
  /// All arguments are borrowed.
  FaceNormals(const NoiseLevel& noise, const WindowChoice& choice, const Buffer<std::uint8_t>& is_moved,
              const PointBuffer& normals)
      : noise_(noise), choice_(choice), is_moved_(is_moved), normals_(normals) {}

  /// Zero where it is not known.
  Eigen::RowVector3d operator()(int q) const {
    if (noise_.noisy[q] == 0 || (choice_.window[q] < Windows::base_size && is_moved_[q] == 0))
      return Eigen::RowVector3d::Zero();
    return normals_.row(q);
  }

  bool areOfSeveralFaces(const Windows::Pool& pool) const {
    Eigen::RowVector3d first = Eigen::RowVector3d::Zero();
    return std::ranges::any_of(pool, [&](int q) {
      const Eigen::RowVector3d normal = (*this)(q);
      if (first.isZero(0)) first = normal;
      return !normal.isZero(0) && !(std::abs(normal.dot(first)) > CreaseModel::same_face);
    });
  }

 private:
  const NoiseLevel& noise_;
  const WindowChoice& choice_;
  const Buffer<std::uint8_t>& is_moved_;
  const PointBuffer& normals_;
};

}  // namespace

Buffer<std::uint8_t> moveNextToCreases(const PointsView& points, const NeighborLists& lists, const Windows& windows,
                                       const NoiseLevel& noise, const WindowChoice& choice, std::span<const int> which,
                                       std::span<const int> fitted, const Workers& workers, PointBuffer& move) {
  const CreaseMover mover(points, windows, noise);
  Buffer<std::uint8_t> is_moved(windows.base.size(), 0);
  PointBuffer normals(windows.size());
  workers.forBlocks("noise", std::ssize(fitted), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int p : fitted.subspan(begin, end - begin))
      normals.row(p) = mover.normalOf(p, std::max<int>(choice.window[p], Windows::base_size));
  });
  const auto forEachListed = [&](std::span<const int> list, int times, const auto& visit) {
    workers.forBlocks("noise", std::ssize(list), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      CreaseScratch scratch;
      const auto count = [&](int p) { return times * windows.base[p]; };
      const auto take = [&](int p, std::span<const Neighbor> neighbors) {
        scratch.around.take(points, windows, p, neighbors, noise.outlier);
        visit(p, scratch);
      };
      lists.forEach(points, windows, list.subspan(begin, end - begin), count, take);
    });
  };
  const Buffer<int> biased = listedWhere(
      which, workers, [&](int p) { return choice.biased[p] != 0 && choice.window[p] <= Windows::base_size; });
  forEachListed(biased, widest_lender, [&](int p, CreaseScratch& scratch) {
    for (int wider = Windows::base_size + 1; wider >= Windows::base_size; --wider) {
      Eigen::RowVector3d to, normal;
      if (wider <= choice.window[p] || !mover.borrow(p, wider, scratch, to, normal)) continue;
      move.row(p) = to;
      normals.row(p) = normal;
      is_moved[p] = 1;
      break;
    }
  });

  // Where faces meet, residuals grow from window to window as if there were no noise, and corners look like outliers:
  // so points that are not noisy count as well.
  const PointBuffer lent = normals;
  const FaceNormals known(noise, choice, is_moved, lent);
  const Buffer<int> near_several = listedWhere(which, workers, [&](int p) {
    if (noise.noisy[p] != 0)
      return choice.biased[p] != 0 && choice.window[p] <= widest_crossing && known.areOfSeveralFaces(windows.far[p]);
    return noise.variance[p] > leastVariance(windows, p) &&
           std::ranges::any_of(windows.near[p], [&](int q) { return noise.noisy[q] != 0; });
  });
  Buffer<std::uint8_t> is_on_faces(windows.base.size(), 0);
  forEachListed(near_several, faces_within, [&](int p, CreaseScratch& scratch) {
    if (!mover.findFaces(p, known, scratch)) return;
    const auto [position, normal] = scratch.model.nearest();
    if (!(position.squaredNorm() < most_way * most_way * noise.variance[p])) return;
    move.row(p) = position.transpose();
    normals.row(p) = normal.transpose();
    is_on_faces[p] = 1;
  });

  const Buffer<int> others =
      listedWhere(which, workers, [&](int p) { return is_moved[p] != 0 && is_on_faces[p] == 0; });
  for (int round = 0; round < rounds; ++round) {
    const PointBuffer moved = move;
    forEachListed(others, one_side,
                  [&](int p, CreaseScratch& scratch) { move.row(p) += mover.stepOnSide(p, moved, normals, scratch); });
  }
  for (const int p : which) is_moved[p] |= is_on_faces[p];
  return is_moved;
}

}  // namespace tufted
