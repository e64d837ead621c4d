#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/io/write.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted {

/// Values that an algorithm computed, for writeResults().
struct ResultArray {
  std::string name;         ///< name of the file, without extension, and of the field; one word
  Eigen::MatrixXd values;   ///< N x c if per point; otherwise of any shape
  bool per_point = true;    ///< whether the values are also a field of the copies of the points
  bool is_integer = false;  ///< whether the values are integers, which NAME.npy holds as int32
};

/// Options of writeResults().
struct ResultOptions {
  std::vector<Format> copies = {Format::ply};  ///< copies of the points with the results as fields: ply, pcd, or none
  std::string report = "{}\n";                 ///< a JSON object for report.json
  Progress progress = {};                      ///< called between files; returning false leaves no file
};

/// The names of the files that writeResults writes.
std::vector<std::string> resultFiles(const std::vector<ResultArray>& arrays, const ResultOptions& options);

/// Writes results into the directory `dir`, which is made if missing, in the same way as writeLaplacian:
///   NAME.npy               float64, or int32; one column: N values, else rows x columns in C order
///   points.ply, points.pcd as writeLaplacian writes them, with each array per point as a field NAME of float32;
///                          several columns: NAME_0, NAME_1, ... in PLY, COUNT values in PCD
///   report.json            options.report, and as `files` the names of all files of this result
/// @param laplacian that the results were computed with. One without points, as `Laplacian()`, stands for none: the
///        copies then have neither mass nor boundary, status and representative.
/// @throws InvalidInput if arrays differ in length, a name is not one word, the pose of the sensor is not valid, a
///         format is neither ply nor pcd or options.report is no JSON object
/// @throws IoError naming the path
/// @throws Cancelled when `options.progress` returns false
void writeResults(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                  const std::vector<ResultArray>& arrays, const ResultOptions& options = {});

/// The names of the files of the last result in a folder, which its report.json lists. Whatever else lies there is of
/// an earlier result, or somebody else's, and no reader of folders takes it.
/// @throws IoError for a folder without a report.json that lists files
std::vector<std::string> filesOfResult(const std::filesystem::path& dir);

/// Reads the points of the last result in a folder: of a cloud's Laplacian points.pcd before points.ply, otherwise
/// points.ply before points.pcd. Polygons and merged vertices are those that report.json counts.
/// @return 0 points where the last result has neither
/// @throws IoError as filesOfResult() and read()
/// @throws Cancelled when `progress` returns false
Geometry readPoints(const std::filesystem::path& dir, const Progress& progress = {});

/// Reads what writeLaplacian wrote with Format::npz: L.npz, M.npy, status.npy, representative.npy, boundary.npy,
/// frames.npy, noise.npy, component_edges.npy, and of report.json the kind and the Report. Files that report.json does
/// not list are not taken. Sign::igl and dummy values are undone. Versions before noise.npy and component_edges.npy are
/// read without noise, and with the report's mean edges for every component. `cover_areas` is M if that holds the
/// cover's areas, else empty. If report.json has no kind, as in older files, the kind follows from the options of the
/// build in it; without these a cover is refused, and nothing else depends on the kind.
///
/// What is read must be a Laplacian, by the rules of validate(): L is symmetric bit for bit, its off-diagonals are <= 0
/// and its rows sum to 0 within the rounding of their own sum; active points have a positive diagonal, all others no
/// entry and no mass; nothing is negative or not finite in M; a coincident point names an earlier one that stands for
/// itself. This is O(N), a fifth of the time of reading; the factorisation and the cover are left to validate().
///
/// L.npz and cover.npz may be deflated, to a thousandth. Before their arrays are read, they must fit each other and the
/// files of the points, which are not deflated. They are read in pieces: beside 128 bytes for each byte of the files
/// this takes four times what is returned.
/// @param with_cover reads cover.npz as well, if Format::cover was among those written; otherwise there is no cover
/// @throws IoError naming the file that is missing, damaged or does not fit the others, the entry that breaks a rule,
///         or the number of the report that does not fit its type
Laplacian readLaplacian(const std::filesystem::path& dir, bool with_cover = true);

/// Reads the files of readLaplacian() without checking that they hold a Laplacian, for validate(), which says how often
/// each promise is broken.
/// @throws IoError naming the file that is missing, damaged or does not fit the others
Laplacian readUncheckedLaplacian(const std::filesystem::path& dir, bool with_cover = true);

/// A checksum of L and M, by which results are known to belong to a Laplacian. Equal bits have equal checksums, however
/// they were built or written (Sign::igl and dummy values do not count); it is no protection against forgery.
/// @returns 16 hexadecimal digits
std::string checksum(const Laplacian& laplacian);

/// Reads the eigenpairs that `tufted spectrum` wrote: evals.npy, evecs.npy, and of report.json the checksum of the
/// Laplacian that they belong to.
/// @param laplacian the one they belong to, restricted to the components that they were computed of
/// @return method "read"; null_space counts the zeros that were written, residual is measured anew
/// @throws InvalidInput for arrays of the wrong size
/// @throws IoError naming the file that is missing, damaged or of another Laplacian, or whose vectors are not the
///         eigenvectors of the values
Spectrum readSpectrum(const std::filesystem::path& dir, const Laplacian& laplacian);

/// Reads numbers of any type from a .npy file.
/// @return N x c, one column for an array of N values
/// @throws IoError naming the path
Eigen::MatrixXd readArray(const std::filesystem::path& path);

}  // namespace tufted
