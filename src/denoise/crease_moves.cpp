#include "denoise/crease_moves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "denoise/crease_model.h"
#include "denoise/pooling.h"
#include "denoise/quadratic_fit.h"
#include "denoise/window_surface.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr double fade = 0.05;        // of the noise's variance, by which windows with larger residuals count less
constexpr double height_fade = 1.5;  // sigmas, by which windows whose surface is farther away count less
constexpr double most_height = 3;    // sigmas from the best window's surface
constexpr double least_lent = 50;    // of the best window's logarithm; those that count less do not change the sum
constexpr double same_side = 0.95;   // cosine between the normals of windows on one side of a crease
constexpr int rounds = 2;            // of fits through one side
constexpr double agreement = 0.9;    // cosine between the normals of points on one side
constexpr int least_on_side = 12;    // twice as many points as coefficients
constexpr double most_step = 2;      // sigmas in one round
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
  Buffer<Lender> lenders;
  CreaseModel model;
};

/// Fits through the neighbours on one side of a crease, which are solved together; memory of one worker.
struct SideScratch {
  Buffer<int> side, listed;
  OffsetBuffer offsets;
  Buffer<HeightMoments> moments, moments_of_moved;
  Buffer<HeightFit> fits, fits_of_moved;

  void solve() {
    fits.resize(moments.size());
    fitHeights(moments, fits);
    fits_of_moved.resize(moments_of_moved.size());
    fitHeights(moments_of_moved, fits_of_moved);
  }
};

class CreaseMover {
 public:
  /// All arguments are borrowed.
  CreaseMover(const PointsView& points, const NeighborLists& lists, const Windows& windows, const NoiseLevel& noise)
      : points_(points), lists_(lists), windows_(windows), noise_(noise) {}

  /// A move of p onto the surfaces of windows of one size around its neighbours: of those that explain their points by
  /// noise alone, best first, and lie on the same side of the crease as the best. False where none does.
  bool borrow(int p, int window, CreaseScratch& scratch, Eigen::RowVector3d& move, Eigen::RowVector3d& normal) const {
    const double variance = noise_.variance[p];
    const std::span<const int> all = lists_.of(p);
    const auto around = all.first(std::min<std::size_t>(windows_.base[p] / 2 << window, all.size()));
    scratch.lenders.clear();
    const Lender* best = nullptr;
    double best_variance = 0;
    scratch.lenders.reserve(around.size() + 1);
    const auto ask = [&](int q) {
      const WindowFit& fit = windows_.fits[q][window];
      const double misfit = std::max(fit.variance / variance - 1, 0.0) / fade;
      if (!(misfit < least_lent)) return;
      const Eigen::Vector3d d = (points_.row(p) - points_.row(q)).transpose();
      if (!(d.squaredNorm() <= widened_radius * fit.radius * fit.radius)) return;
      const WindowSurface surface = surfaceAt(windows_, q, window, d);
      const double distance = surface.height * surface.height / (2 * height_fade * height_fade * variance);
      if (!(misfit + distance < least_lent)) return;
      scratch.lenders.push_back({std::exp(-misfit - distance), surface});
      if (best != nullptr && !(scratch.lenders.back().weight > best->weight)) return;
      best = &scratch.lenders.back();
      best_variance = fit.variance;
    };
    const auto isExplained = [&](int q) { return windows_.fits[q][window].variance < explained * variance; };
    if (!isExplained(p) && std::ranges::none_of(around, isExplained)) return false;
    ask(p);
    for (const int q : around) ask(q);
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

  /// Takes what fits through the neighbours on the side of p are made from. False where these are few.
  /// @param as_they_are whether also where they are, not only where they have moved to
  bool takeSide(int p, const PointBuffer& normals, const PointBuffer& moved, bool as_they_are,
                SideScratch& scratch) const {
    const std::span<const int> around = lists_.of(p);
    const std::span<const std::uint8_t> skipped = lists_.skippedOf(p);
    const Eigen::RowVector3d normal = normals.row(p);
    Buffer<int>& side = scratch.side;
    side.clear();
    for (std::size_t i = 0; i < around.size(); ++i) {
      const int q = around[i];
      if (skipped[i] == 0 && noise_.noisy[q] != 0 && std::abs(normals.row(q).dot(normal)) > agreement)
        side.push_back(q);
    }
    if (std::ssize(side) < least_on_side) return false;
    if (as_they_are) {
      scratch.offsets.fill(static_cast<int>(side.size()),
                           [&](int i) -> Eigen::RowVector3d { return points_.row(side[i]) - points_.row(p); });
      scratch.moments.push_back(heightMoments(scratch.offsets.view(), normal.transpose(), windows_.radius[p]));
    }
    takeMoved(points_, moved, p, side, scratch.offsets);
    scratch.moments_of_moved.push_back(heightMoments(scratch.offsets.view(), normal.transpose(), windows_.radius[p]));
    return true;
  }

  /// Whether noise explains the fit through the points on the side of p.
  bool isSmooth(int p, const HeightFit& fit) const {
    return fit.is_valid && fit.variance < explained * noise_.variance[p];
  }

  /// Whether the step onto a fit is no farther than noise explains.
  bool isNear(int p, const HeightFit& fit) const {
    return fit.is_valid && fit.height * fit.height < most_step * most_step * noise_.variance[p];
  }

  /// Finds the faces that meet around p.
  /// @param known normals of the surface at all points, zero where it is not known
  bool findFaces(int p, const PointBuffer& known, CreaseModel& model) const {
    const std::span<const int> around = lists_.of(p);
    const std::span<const std::uint8_t> skipped = lists_.skippedOf(p);
    model.start(static_cast<int>(around.size()) + 1, noise_.variance[p], windows_.radius[p]);
    model.add(Eigen::RowVector3d::Zero(), known.row(p));
    for (std::size_t i = 0; i < around.size(); ++i)
      if (skipped[i] == 0) model.add(points_.row(around[i]) - points_.row(p), known.row(around[i]));
    const auto all = static_cast<int>(around.size());
    model.group();
    return model.fit(all) || model.fit(all / 2);  // all may be around more than one crease
  }

 private:
  PointsView points_;
  const NeighborLists& lists_;
  const Windows& windows_;
  const NoiseLevel& noise_;
};

/// Moves points from where they are by now onto fits through the neighbours on their side, where they have moved to.
/// They stay where these neighbours are few, or do not lie on one smooth surface.
void moveOnSides(const CreaseMover& mover, const PointBuffer& normals, std::span<const int> which,
                 const Workers& workers, PointBuffer& move) {
  Buffer<std::uint8_t> is_smooth(which.size(), 1);
  for (int round = 0; round < rounds; ++round) {
    const PointBuffer moved = move;
    workers.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      SideScratch scratch;
      for (std::int64_t i = begin; i < end; ++i) {
        if (is_smooth[i] == 0) continue;
        if (mover.takeSide(which[i], normals, moved, round == 0, scratch))
          scratch.listed.push_back(static_cast<int>(i));
        else
          is_smooth[i] = 0;
      }
      scratch.solve();
      for (std::size_t j = 0; j < scratch.listed.size(); ++j) {
        const int i = scratch.listed[j], p = which[i];
        if (round == 0 && !mover.isSmooth(p, scratch.fits[j])) is_smooth[i] = 0;
        const HeightFit& fit = scratch.fits_of_moved[j];
        if (is_smooth[i] != 0 && mover.isNear(p, fit)) move.row(p) += fit.height * normals.row(p);
      }
    });
  }
}

/// @param normals of the surface around points, zero where they are not known
bool areOfSeveralFaces(const Windows::Pool& pool, const PointBuffer& normals) {
  Eigen::RowVector3d first = Eigen::RowVector3d::Zero();
  return std::ranges::any_of(pool, [&](int q) {
    const Eigen::RowVector3d normal = normals.row(q);
    if (first.isZero(0)) first = normal;
    return !normal.isZero(0) && !(std::abs(normal.dot(first)) > CreaseModel::same_face);
  });
}

}  // namespace

Buffer<std::uint8_t> moveNextToCreases(const PointsView& points, const NeighborLists& lists, const Windows& windows,
                                       const NoiseLevel& noise, const WindowChoice& choice, std::span<const int> which,
                                       std::span<const int> around, const Workers& workers, PointBuffer& normals,
                                       PointBuffer& move) {
  const CreaseMover mover(points, lists, windows, noise);
  Buffer<std::uint8_t> is_moved(windows.base.size(), 0);
  const auto forEachListed = [&](std::span<const int> list, const auto& visit) {
    workers.forBlocks("noise", std::ssize(list), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      CreaseScratch scratch;
      for (const int p : list.subspan(begin, end - begin)) visit(p, scratch);
    });
  };
  const Buffer<int> biased = listedWhere(
      which, workers, [&](int p) { return choice.biased[p] != 0 && choice.window[p] <= Windows::base_size; });
  forEachListed(biased, [&](int p, CreaseScratch& scratch) {
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
  PointBuffer known(windows.size());  // the normals around points whose windows lie within one face, else zero
  workers.forBlocks("noise", std::ssize(around), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int p : around.subspan(begin, end - begin)) {
      const bool is_known = noise.noisy[p] != 0 && (choice.window[p] >= Windows::base_size || is_moved[p] != 0);
      known.row(p) = is_known ? Eigen::RowVector3d(normals.row(p)) : Eigen::RowVector3d::Zero();
    }
  });
  const Buffer<int> near_several = listedWhere(which, workers, [&](int p) {
    if (noise.noisy[p] != 0)
      return choice.biased[p] != 0 && choice.window[p] <= widest_crossing && areOfSeveralFaces(windows.far[p], known);
    return noise.variance[p] > leastVariance(windows, p) &&
           std::ranges::any_of(windows.near[p], [&](int q) { return noise.noisy[q] != 0; });
  });
  Buffer<std::uint8_t> is_on_faces(windows.base.size(), 0);
  forEachListed(near_several, [&](int p, CreaseScratch& scratch) {
    if (!mover.findFaces(p, known, scratch.model)) return;
    const auto [position, normal] = scratch.model.nearest();
    if (!(position.squaredNorm() < most_way * most_way * noise.variance[p])) return;
    move.row(p) = position.transpose();
    normals.row(p) = normal.transpose();
    is_on_faces[p] = 1;
  });

  const Buffer<int> others =
      listedWhere(which, workers, [&](int p) { return is_moved[p] != 0 && is_on_faces[p] == 0; });
  moveOnSides(mover, normals, others, workers, move);
  for (const int p : which) is_moved[p] |= is_on_faces[p];
  return is_moved;
}

}  // namespace tufted
