#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tufted/tiles.h"

namespace tufted {

/// What report.json of a build by tiles says besides its TileReport.
struct TileSourceText {
  std::string source = {};     ///< name of the file of the points
  std::string selection = {};  ///< what select() kept of it, a JSON object; empty: all points
  std::string preset = {};     ///< name of the preset
  std::string memory = {};     ///< the memory as the user gave it; empty: TileOptions::memory
  bool keep_noise = false;     ///< whether the user asked not to move noisy points
  std::vector<int> rows = {};  ///< row in that file of each point; empty: the points are those of the file, in order
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
///   file_row.npy        int32, N, TileSourceText::rows, if not empty
///   report.json         the TileReport, the options, and as `files` the names of all files of this result
/// While it runs, files without names in `dir` take 32 bytes per point and about 180 bytes per row that is built. All
/// files appear together, as with writeLaplacian().
/// @param options `folder` is not used
/// @return the same as laplacianByTiles()
/// @throws as laplacianByTiles(); InvalidInput if `rows` of `text` has another size than the points; IoError naming the
/// path
TileReport writeLaplacianByTiles(const std::filesystem::path& dir, const PointSource& source,
                                 const TileOptions& options, const TileSourceText& text = {});

}  // namespace tufted
