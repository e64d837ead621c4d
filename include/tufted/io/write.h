#pragma once

#include <filesystem>
#include <string>

#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted {

struct WriteOptions {
  std::string source;                   ///< the file the points are from, recorded in report.json
  const CloudOptions* cloud = nullptr;  ///< the options of the build, recorded in report.json; borrowed
  const MeshOptions* mesh = nullptr;    ///< the same for a mesh; borrowed
  Progress progress = {};               ///< called between files; returning false leaves no file
};

/// The files that writeLaplacian writes.
inline constexpr const char* result_files[] = {"L.npz",        "M.npy",       "status.npy", "representative.npy",
                                               "boundary.npy", "report.json", "points.ply"};

/// Writes a Laplacian into the directory `dir`, which is made if missing:
///   L.npz               scipy.sparse.load_npz, csc, float64 with int32 indices
///   M.npy               float64, N
///   status.npy          uint8, N, see PointStatus
///   representative.npy  int32, N
///   boundary.npy        uint8, N, 0 or 1
///   report.json         the Report, with sign and scale stated, and what was changed in reading the input
///   points.ply          binary little endian: x y z and normals (where known) as double, the fields of the input,
///                       mass (double), boundary, status (uchar), representative (int), and the triangles of a mesh
/// In points.ply a field of several values becomes `name_0`, `name_1`, ...; packed colours (rgb, rgba) become red,
/// green, blue (and alpha); 64-bit integers become double, the largest type of PLY; an organized cloud states its
/// size as obj_info num_cols and num_rows.
/// All files are written under temporary names and, when all are complete, renamed one after the other: no file is
/// ever half there, but for a moment new files stand beside old ones. Files of these names are replaced.
/// @throws InvalidInput if the arrays of `laplacian` and `geometry` differ in length
/// @throws IoError naming the path
/// @throws Cancelled when `options.progress` returns false
void writeLaplacian(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const WriteOptions& options = {});

/// The report as a JSON object (two-space indent), with a member per member of Report.
std::string toJson(const Report& report);

}  // namespace tufted
