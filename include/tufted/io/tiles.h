#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/io/select.h"
#include "tufted/tiles.h"

namespace tufted {

/// Calls take(rows) for consecutive batches of points: the row of each point in their file, counted from 0, ascending.
using FileRows = std::function<void(const std::function<void(const std::vector<std::int64_t>& rows)>& take)>;

/// The points of a file.
struct FileSource : PointSource {
  std::int64_t of = 0;    ///< number of points in the file
  std::int64_t kept = 0;  ///< number of points that the selection keeps
  double memory = 0;      ///< bytes that the source holds; a batch is among those that TileOptions::memory counts
  /// Rows of the points in the file; null if the points are those of the file, in order. That is so for an organized
  /// cloud, too: it has missing points where the selection drops some.
  FileRows rows = {};
  std::vector<std::string> notes = {};  ///< see Geometry::notes
};

/// The points of a file that a selection keeps. LAS, binary PLY, binary PCD and NPY are read in batches, as often as
/// the source is, so they may be larger than memory. Read once, and held, are: files of other formats, compressed PCD,
/// PLY with lists at its points or elements before them, grids of NPY in Fortran's order, files with headers of more
/// than a MiB, NPY with more than 100 values per point and no names; all files for Selection::thin; and for
/// Selection::where NPY with six or more values per point and no names.
///
/// Passes after the first throw IoError naming the byte if the file has changed. Elements behind the points of a PLY
/// are not looked at.
/// @param as as in read()
/// @throws IoError as read(); InvalidInput as select(), and for a file with faces unless it is read as a cloud
/// @throws Cancelled when `progress` returns false
FileSource sourceOf(const std::filesystem::path& path, ReadAs as = ReadAs::automatic, const Selection& selection = {},
                    const Progress& progress = {});

/// The points of a cloud in memory that a selection keeps. Everything else of the cloud is freed.
/// @param name of the file, for messages
FileSource sourceOf(Geometry geometry, const std::string& name, const Selection& selection = {},
                    const Progress& progress = {});

/// What report.json of a build by tiles says besides its TileReport.
struct TileSourceText {
  std::string source = {};     ///< name of the file of the points
  std::string selection = {};  ///< what select() kept of it, a JSON object; empty: all points
  std::string preset = {};     ///< name of the preset
  std::string memory = {};     ///< the memory as the user gave it; empty: TileOptions::memory
  bool keep_noise = false;     ///< whether the user asked not to move noisy points
  std::int64_t of = 0;         ///< number of points in that file, must be given with `rows`
  FileRows rows = {};          ///< see FileSource
};

/// Names of the files that writeLaplacianByTiles() writes, if all points of the file are kept.
std::vector<std::string> tileFiles();

/// Builds L and M of a cloud by tiles, see laplacianByTiles(), and writes them into the directory `dir`, which is
/// created if missing, row after row: no file needs to fit into memory.
///   L_indptr.npy, L_indices.npy, L_data.npy  int64 (N + 1), int64, float64: for scipy.sparse.csr_matrix; L_ij and L_ji
///                       may differ in their last bits if two tiles have built them
///   M.npy               float64, N
///   status.npy          uint8, N, see PointStatus
///   representative.npy  int64, N, counted from 0
///   boundary.npy        uint8, N, see Boundary
///   normals.npy         float64, N x 3, of arbitrary sign; 0 for points that are not finite
///   file_row.npy        N, TileSourceText::rows, if not null; int32, or int64 if the file has 2^31 points or more
///   report.json         the TileReport, the options, and as `files` the names of all files of this result
/// While it runs, files without names in `dir` take 32 bytes per point and about 180 bytes per row that is built. All
/// files appear together, as with writeLaplacian().
/// @param options `folder` is not used
/// @return the same as laplacianByTiles()
/// @throws as laplacianByTiles(); InvalidInput if `rows` of `text` gives another number of rows than there are points;
/// IoError naming the path
TileReport writeLaplacianByTiles(const std::filesystem::path& dir, const PointSource& source,
                                 const TileOptions& options, const TileSourceText& text = {});

}  // namespace tufted
