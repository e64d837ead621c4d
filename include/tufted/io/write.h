#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tufted/denoise.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Files that writeLaplacian() can write, beside report.json, which it always writes.
enum class Format : std::uint8_t {
  npz,    ///< L.npz and the .npy files below: NumPy and SciPy, and what readLaplacian() reads
  mtx,    ///< L.mtx, M.mtx: Matrix Market
  mat,    ///< laplacian.mat: MATLAB 5, at most 2^31 - 1 bytes per variable
  spmat,  ///< L.spmat, M.spmat: triplets counted from 1, as the paper's program writes them
  petsc,  ///< L.petsc, M.petsc: PETSc's binary files of a matrix and a vector
  ply,    ///< points.ply
  pcd,    ///< points.pcd
  las,    ///< points.las
  cover,  ///< cover.npz: the cover, larger than all other files together; only distances, paths and triangles need it
  triangles,  ///< triangles.ply: triangles for display, see surfaceTriangles(); of a mesh its own
};

/// Sign of L in the files. M is positive in both.
enum class Sign : std::uint8_t {
  psd,  ///< positive semidefinite, as Laplacian::L
  igl,  ///< negated, as in libigl and PMP: negative semidefinite, off-diagonals >= 0
};

/// Options of writeLaplacian().
struct WriteOptions {
  std::vector<Format> formats = {Format::npz, Format::ply};  ///< what to write beside report.json
  Sign sign = Sign::psd;                                     ///< sign of L in the files
  /// Whether every point that is not active gets 1 (-1 with Sign::igl) on the diagonal of L and dummyMass() in M, for
  /// programs that expect full rank. The paper's program writes the same.
  bool dummy = false;
  std::string source = {};              ///< name of the file of the points, recorded in report.json
  std::string selection = {};           ///< what select() kept of that file, a JSON object; empty: all points
  const CloudOptions* cloud = nullptr;  ///< options of a cloud's build, recorded in report.json; borrowed
  const MeshOptions* mesh = nullptr;    ///< options of a mesh's build, recorded in report.json; borrowed
  /// For a Laplacian that was read from a folder: the options of its build as the report.json there has them, a JSON
  /// object. Recorded if neither `cloud` nor `mesh` is given.
  std::string build_options = {};
  Progress progress = {};  ///< called between files; returning false leaves no file
};

/// Names of the files that writeLaplacian() writes for these formats, report.json included.
std::vector<std::string> resultFiles(const std::vector<Format>& formats);

/// Writes a Laplacian into the directory `dir`, which is created if missing. readLaplacian() reads the same
/// bits back.
///   L.npz               scipy.sparse.load_npz, csc, float64 with int32 indices
///   M.npy               float64, N
///   status.npy          uint8, N, see PointStatus
///   representative.npy  int32, N, counted from 0
///   boundary.npy        uint8, N, see Boundary
///   frames.npy          float64, N x 3 x 3: tangent, cross(normal, tangent) and normal; of meshes 0 x 3 x 3
///   noise.npy           float64, see Laplacian::noise
///   component_edges.npy float64, C x 3: sides, mean and mean_square of ComponentEdges, a row per component
///   cover.npz           the cover, see IntrinsicTriangulation: faces and glue (int32), length (float64), F x 3 each
///   L.mtx               coordinate real symmetric: the lower triangle; an L that is not symmetric loses the upper one
///   M.mtx               array real general, N x 1
///   laplacian.mat       L (sparse), M, status, representative, boundary (N x 1) and the text `conventions`
///   L.spmat             a line `row column value` per entry, and the last diagonal entry even if 0, so that MATLAB's
///                       spconvert(load(...)) has the right size
///   M.spmat             the diagonal matrix of the N masses, in the same way
///   L.petsc, M.petsc    for PETSc's MatLoad() and VecLoad(), with 32-bit indices
///   points.ply          the points, little endian; the triangles of a mesh
///   points.pcd          the points, binary
///   points.las          the points, LAS 1.4
///   triangles.ply       as points.ply, but at Laplacian::positions, with surfaceTriangles() or those of the mesh
///   measured_positions.npy  float64, N x 3, see Laplacian::positions
///   components.npy      int32, N, see Laplacian::component
///   file_row.npy        int32, N, the field of select(), if the points have it
///   report.json         the kind, the Report, sign and scale of L, changes made in reading the input, and as `files`
///                       the names of all files of this result
/// The points have x y z and normals (where known), the fields of the input, mass (float64), boundary, status (uint8)
/// and representative (int32). x y z are float32 where that loses nothing, else float64: PCL turns wider coordinates
/// into zeros when it converts them to its point types. So are normals of the input; normals of the build are float32.
/// PLY: a field of several values becomes `name_0`, `name_1`, ...; packed colours (rgb, rgba) become red, green, blue
/// (and alpha); 64-bit integers become double, the largest type of PLY; an organized cloud states its size as obj_info
/// num_cols and num_rows, and the sensor's pose as viewpoint. PCD: normals are normal_x, normal_y, normal_z; red,
/// green, blue (and alpha) of 8 bits become a packed rgb (rgba). LAS: fields that an item of the point format can hold
/// become that item, with colours of 8 bits widened to 16; all others are extra bytes, one for each value, with names
/// of at most 32 bytes and NaN for no data. Geometry::las_header gives the point format (without waves), scale, offset
/// and variable length records; without it the format is 6, or 7 with colours, and the scale at most 1e-8 of half the
/// extent. LAS holds no triangles.
///
/// All files are written into a hidden folder `dir`/.tufted-XXXXXX, flushed to disk and then renamed one after the
/// other. Existing files of these names are replaced; links, pipes and devices of these names are refused; all other
/// files stay, and are not part of the result: `files` in report.json lists those that are. If an exception is thrown,
/// `dir` is as before. A process that is killed while it renames leaves new files beside old ones, and the replaced
/// ones in `dir`/.tufted-XXXXXX/old. If several processes write into one `dir`, each renames all its files before the
/// next one does.
/// @throws InvalidInput if the arrays of `laplacian` and `geometry` differ in length, the name of a field is not one
/// word, the pose of the sensor is not valid, `build_options` or `selection` is no JSON object, or the cover is asked
/// for and was not kept; if LAS cannot hold a point, which is not finite or out of the range of scale and offset, or
/// more than 341 values per point; for Format::triangles for the same reasons as surfaceTriangles()
/// @throws IoError naming the path
/// @throws Cancelled when `options.progress` returns false
void writeLaplacian(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const WriteOptions& options = {});

/// Checks, before results are computed, that writeLaplacian(), writeResults() or writeOperators() can write them:
/// creates `dir` if missing and a folder in it, as they do, and removes both again.
/// @param files names of the results
/// @throws IoError naming the path, also where a directory, a link, a pipe or a device has the name of a result
void checkWritable(const std::filesystem::path& dir, const std::vector<std::string>& files);

/// The report of a build as a JSON object (two-space indent), one entry per member of Report.
std::string toJson(const Report& report);
/// The report of denoise() as a JSON object (two-space indent), one entry per member of DenoiseReport.
std::string toJson(const DenoiseReport& report);

}  // namespace tufted
