#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Points that are read several times, in batches, because there may be more of them than memory holds.
struct PointSource {
  std::int64_t size = 0;  ///< number of points
  /// Calls take(batch) for consecutive batches of rows, n x 3, until all points were given. Every call gives the same
  /// points in the same order.
  std::function<void(const std::function<void(const PointsRef& batch)>& take)> pass;
};

/// Points in memory as a source. @param points borrowed for the life of the result
PointSource sourceOf(const PointsRef& points);

/// A face of the cover around one of its corners. Equal faces are one: front and back, and the copies that the corners
/// of a triangle find.
struct TileFace {
  std::array<std::int64_t, 3> corners;  ///< points; after flips two of them may be the same
  std::array<double, 3> opposite;       ///< length of the side opposite each corner
  int copies = 1;                       ///< how many faces of the cover are this one
};

/// Rows of L, M and what is known of their points. Points are counted from 0 in the order of their source.
struct TileRows {
  std::vector<std::int64_t> point;           ///< the point of each row
  std::vector<std::int64_t> representative;  ///< per row, see Laplacian::representative
  std::vector<PointStatus> status;           ///< per row
  std::vector<Boundary> boundary;            ///< per row
  VectorXd M;                                ///< per row, area in length^2
  Points normals;                            ///< rows x 3, of arbitrary sign
  std::vector<std::int64_t> begin;           ///< per row, its first entry in `column` and `value`; and the end
  std::vector<std::int64_t> column;          ///< the other point of each entry, ascending within a row
  std::vector<double> value;                 ///< entries of L
  std::vector<std::int64_t> face_begin;      ///< with TileOptions::faces: as `begin`, in `faces`
  std::vector<TileFace> faces;               ///< with TileOptions::faces: those around each row's point
};

/// The processes that build the tiles of one cloud, each its own ones. All of them call laplacianByTiles() with the
/// same source and options.
struct TileProcesses {
  int number = 0;  ///< number of this process, from 0
  int count = 1;   ///< number of processes
  /// Gives every process the pairs of all, in any order. Called by each process equally often.
  std::function<std::vector<std::pair<int, int>>(const std::vector<std::pair<int, int>>& pairs)> share = {};
};

/// Options of laplacianByTiles().
struct TileOptions {
  /// How rows are built. `progress` is not called; what belongs to single points, and other choices of `paper` than the
  /// default, are refused.
  CloudOptions cloud = {};
  double memory = 4e9;  ///< bytes that may be taken beside what the source takes; tiles get smaller with it
  bool faces = false;   ///< whether rows come with the faces around them, some 350 bytes per row
  int tiles = 0;        ///< number of tiles; 0: as few as fit in memory. Rounded up to a multiple of the processes
  std::filesystem::path folder = ".";  ///< a folder with room for 32 bytes per point, in a file without a name
  Progress progress = {};              ///< called for every batch of points that is read, and during every build
  TileProcesses processes = {};        ///< the process that calls, and the others; by default it is the only one
};

/// What laplacianByTiles() did. Of several processes, the counts of rows, of entries and of builds, the area and the
/// margin are those of this one.
struct TileReport {
  std::int64_t points = 0;       ///< number of points
  std::int64_t active = 0;       ///< points that take part
  std::int64_t not_finite = 0;   ///< see PointStatus
  std::int64_t coincident = 0;   ///< see PointStatus
  std::int64_t isolated = 0;     ///< see PointStatus
  std::int64_t nonzeros = 0;     ///< entries of L
  double area = 0;               ///< sum of M
  std::int64_t cells = 0;        ///< cells of the grid that hold points
  int tiles = 0;                 ///< number of tiles
  int builds = 0;                ///< number of builds; those beyond `tiles` built parts of tiles, see docs/scale.md
  std::int64_t most_points = 0;  ///< most points that a build held
  double margin = 0;             ///< points of all builds per point, less 1
};

/// Sentences about what a build by tiles has found that users should know, see warnings().
std::vector<std::string> warnings(const TileReport& report);

/// Builds L and M of a cloud by tiles: the rows that pointCloudLaplacian() gives, up to rounding, in memory for one
/// tile. A tile holds the points around it as well. It knows how far each of its decisions has looked, and is built
/// again with more points if that was beyond what it held.
///
/// Not built: the cover, components, and positions moved out of noise (CloudSteps::denoise must be false).
/// @param take called with the rows of each tile; if rows of a point are given again, they replace earlier ones. Rows
/// are final when the function returns; before, those that depend on far stars may differ from the whole. No rows are
/// given for points that are not finite
/// @throws InvalidInput for options out of range, `cloud` with normals, neighborhoods, a structure or a viewpoint, with
/// denoise, or with options of the paper that need a whole cover; if what the rows of one cell depend on does not fit
/// in memory. It may be thrown in one process alone, while the others wait in `share`
/// @throws IoError if the file in `folder` cannot be written
/// @throws Cancelled when `progress` returns false
TileReport laplacianByTiles(const PointSource& source, const TileOptions& options,
                            const std::function<void(const TileRows&)>& take);

}  // namespace tufted
