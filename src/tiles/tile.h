#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "pipeline/build.h"
#include "tiles/cells.h"
#include "tiles/sorted_points.h"
#include "tufted/laplacian.h"
#include "tufted/tiles.h"

namespace tufted {

/// What a tile has to do.
struct TileTask {
  std::vector<int> own;           ///< cells whose rows are wanted, ascending
  std::vector<int> required;      ///< cells with a star that has triangles in `own` from afar, found by other tiles
  std::vector<int> lacking = {};  ///< cells whose stars earlier builds lacked
  std::vector<int> kept = {};     ///< cells whose points earlier builds searched, or lacked
};

/// Some cells whose rows are built, and the cells around them whose points are held for that.
///
/// A star is *certain* if everything that its search could meet is held; then it is the star of the whole cloud. The
/// row of a point depends on the stars around it: some triangles far, and as far as the circumcircles of its faces
/// reach after flips, since what lies outside of an empty circle cannot change its face. If all of these are certain,
/// the row is that of the whole cloud. Otherwise the tile says which cells it lacks for which of its own ones.
class Tile final : public CloudPart {
 public:
  Tile(const SortedPoints& points, const Scaling& whole, TileTask task);

  /// Chooses the cells that are held.
  void holdMargin(const CloudOptions& options);
  std::int64_t heldPoints() const { return held_points_; }

  /// Builds the tile.
  void build(const CloudOptions& options);
  /// The rows of its complete cells. @param has_faces whether they come with their faces
  TileRows rows(bool has_faces) const;

  /// Own cells whose rows are those of the whole cloud, ascending.
  const std::vector<int>& complete() const { return complete_; }
  /// The task of building all other own cells.
  TileTask rest() const;
  /// Pairs of cells that are not near each other, of which a star of an own point in the first one has a triangle with
  /// a point in the second one.
  const std::vector<std::pair<int, int>>& farPairs() const { return far_pairs_; }
  /// The cells on whose stars the rows of complete cells depend, ascending; none if all points were held.
  const std::vector<int>& neededCells() const { return needed_; }

  void takeStars(const SurfaceStars& built, const RankedCloud& cloud) override;

 private:
  /// Adds the faces around the points of rows. @param own these points among those that are held, ascending
  void addFaces(const std::vector<Eigen::Index>& own, TileRows& rows) const;
  void hold(int cell);
  /// Holds cells, and those up to `width` cells from them.
  void holdAround(std::vector<int> cells, int width);
  void readPoints();
  /// Whether all cells at most `radius` from a box are held.
  bool holdsAround(const CellBox& box, double radius) const;
  void findCertainStars(const SurfaceStars& built, const RankedCloud& cloud);
  void findSureCells(const SurfaceStars& built, const RankedCloud& cloud);
  void measureDependence(const SurfaceStars& built, const RankedCloud& cloud);
  void findPairs(const SurfaceStars& built);
  void addFaceRadii();
  /// Finds the own cells that depend on certain stars only, and what the others lack.
  void findComplete(const Progress& progress);
  /// The cells near those that are marked, ascending.
  std::vector<int> nearMarked(const std::vector<std::uint8_t>& is_marked) const;
  /// Lets the nearest cells that are not held be lacking, if none is yet: the next build must hold more.
  void lackMore();
  /// Finds what must be held so that all stars that may have triangles in these cells are certain.
  void findLacking(std::vector<int> cells);

  const SortedPoints& points_;
  const Cells& cells_;
  const TileTask task_;
  std::vector<std::uint8_t> is_own_, is_held_;  ///< by cell
  std::int64_t held_points_ = 0;
  bool isolates_ = false;  ///< whether outliers are isolated
  bool is_whole_ = false;  ///< whether all cells are held
  int hops_ = 0;           ///< how many triangles away a star may change a row

  Points positions_;                  ///< of the points that are held
  std::vector<std::int64_t> number_;  ///< of each of them among all points
  std::vector<int> cell_of_;          ///< of each of them
  Laplacian result_;

  // Set by takeStars().
  Buffer<int> cell_by_rank_;
  RawBuffer<std::uint8_t> is_certain_;   ///< by rank, whether the search met only what is held
  std::vector<std::uint8_t> is_sure_;    ///< by cell, whether all filtered stars are certain
  std::vector<double> reach_;            ///< by cell, how far the searches of its stars have looked
  std::vector<std::vector<int>> needs_;  ///< by cell, the cells with the stars that decide which of its triangles stay
  std::vector<double> dependence_;       ///< by cell, of own ones how far the rows of its points depend on stars
  std::vector<std::pair<int, int>> far_pairs_;
  std::vector<std::pair<int, int>>
      doubtful_pairs_;  ///< (to, from): a star in `from`, which is not sure, has a triangle with `to`
  std::vector<int> complete_, incomplete_, needed_, lacking_, kept_;
};

}  // namespace tufted
