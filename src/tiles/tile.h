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

/// A range of cells whose rows are built, and the cells around it whose points are held for that.
///
/// A star is *certain* if everything that its search could meet is held; then it is the star of the whole cloud. The
/// row of a point depends on the stars around it: some triangles far, and as far as the circumcircles of its faces
/// reach after flips, since what lies outside of an empty circle cannot change its face. If all of these are certain,
/// the row is that of the whole cloud. Otherwise the tile says which cells it lacks.
class Tile final : public CloudPart {
 public:
  /// @param first, last the tile's own cells, [first, last)
  /// @param neighbors k
  /// @param required cells whose stars must be certain although the tile did not see that they reach its own points
  Tile(const SortedPoints& points, const Scaling& whole, int first, int last, int neighbors, std::vector<int> required);

  /// Holds the cells that the last build lacked, and ever more around these.
  void widen();
  std::int64_t heldPoints() const { return held_points_; }

  /// Builds the tile. @returns whether its rows are those of the whole cloud; if not, it lacks cells
  bool build(const CloudOptions& options);
  /// The rows of its own cells, after build().
  TileRows rows() const;

  /// Pairs of cells that are not near each other, of which a star of the tile's own point in the first one has a
  /// triangle with a point in the second one.
  const std::vector<std::pair<int, int>>& farPairs() const { return far_pairs_; }
  /// The cells on whose stars the rows depend, ascending.
  const std::vector<int>& neededCells() const { return needed_; }

  void takeStars(const SurfaceStars& built, const RankedCloud& cloud) override;

 private:
  bool isOwn(int cell) const { return cell >= first_ && cell < last_; }
  int firstMargin(int neighbors) const;
  /// Holds the cells that are lacking, and those up to `width` cells from them.
  void widen(int width);
  void hold(int cell);
  void readPoints();
  /// Whether all cells at most `radius` from a box are held.
  bool holdsAround(const CellBox& box, double radius) const;
  void findCertainStars(const SurfaceStars& built, const RankedCloud& cloud);
  void findLacking(const SurfaceStars& built, const RankedCloud& cloud);
  void measureDependence(const SurfaceStars& built, const RankedCloud& cloud);
  void findPairs(const SurfaceStars& built);
  void addFaceRadii();
  /// Finds the cells on which the rows depend, and those that are lacking for it.
  bool isComplete();

  const SortedPoints& points_;
  const Cells& cells_;
  const int first_, last_;
  const std::vector<int> required_;
  std::vector<std::uint8_t> is_held_;  ///< by cell
  std::int64_t held_points_ = 0;
  std::vector<int> lacking_;  ///< cells to hold in the next build
  bool isolates_ = false;     ///< whether outliers are isolated
  bool is_whole_ = false;     ///< whether all cells are held
  int next_width_ = 1;        ///< of the next widen()
  int hops_ = 0;              ///< how many triangles away a star may change a row

  Points positions_;                  ///< of the points that are held
  std::vector<std::int64_t> number_;  ///< of each of them among all points
  std::vector<int> cell_of_;          ///< of each of them
  Laplacian result_;

  // Set by takeStars().
  Buffer<int> cell_by_rank_;
  RawBuffer<std::uint8_t> is_certain_;                   ///< by rank, whether the search met only what is held
  std::vector<std::uint8_t> is_sure_;                    ///< by cell, whether all filtered stars are certain
  std::vector<std::pair<int, std::vector<int>>> lacks_;  ///< cells that are not sure, and what they lack
  std::vector<double> dependence_;  ///< by own cell, how far the rows of its points depend on stars
  std::vector<std::pair<int, int>> far_pairs_;
  std::vector<std::pair<int, int>> doubtful_pairs_;  ///< as far_pairs_, of all stars in cells that are not sure
  std::vector<int> needed_;
};

}  // namespace tufted
