#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/io/write.h"
#include "tufted/laplacian.h"
#include "tufted/polyline.h"
#include "tufted/spectrum.h"

namespace tufted {

/// An array of computed values, for writeResults().
struct ResultArray {
  std::string name;         ///< name of the file, without extension, and of the field; one word
  Eigen::MatrixXd values;   ///< N x c if per point; otherwise of any shape
  bool per_point = true;    ///< whether the values also become a field of the copies of the points
  bool is_integer = false;  ///< whether the values are integers, stored as int32 in NAME.npy
};

/// Options of writeResults().
struct ResultOptions {
  std::vector<Format> copies = {Format::ply};       ///< copies of the points with the results as fields: ply, pcd, las
  std::string report = "{}\n";                      ///< content of report.json, a JSON object
  Progress progress = {};                           ///< called between files; returning false leaves no file
  std::optional<std::vector<Polyline>> lines = {};  ///< lines on the surface, written as lines.ply, .obj and .svg
};

/// Names of the files that writeResults() writes.
std::vector<std::string> resultFiles(const std::vector<ResultArray>& arrays, const ResultOptions& options);

/// Writes results into the directory `dir`, which is created if missing, in the same way as writeLaplacian():
///   NAME.npy               float64, or int32; one column: N values, else rows x columns in C order
///   points.ply, points.pcd, points.las as writeLaplacian writes them, with each array per point as a field NAME of
///                          float32; several columns: NAME_0, NAME_1, ... in PLY and LAS, COUNT values in PCD
///   file_row.npy           int32, the field of select(), if the points have it
///   lines.ply              with options.lines: their points with `value` (float64) and edges between them
///   lines.obj              with options.lines: an element `l` per line, of closed ones with the first point again
///   lines.svg              with options.lines: a plan to scale, seen from above, x to the right and y up; colours by
///                          `value`, and a legend unless all values are 0. Lines that are not finite are left out.
///   report.json            options.report, and as `files` the names of all files of this result
/// @param laplacian from which the results were computed; empty, as `Laplacian()`, if there is none: the copies then
/// have no mass, boundary, status and representative
/// @param geometry the points and their fields; not used if there are no copies
/// @throws InvalidInput if arrays differ in length, a name is not one word, the pose of the sensor is not valid, a
///         format is neither ply, pcd nor las, LAS cannot hold the points or options.report is no JSON object
/// @throws IoError naming the path
/// @throws Cancelled when `options.progress` returns false
void writeResults(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                  const std::vector<ResultArray>& arrays, const ResultOptions& options = {});

/// Checks, before results are computed, that a point of points.las has room for its own fields and for the results.
/// @param arrays of which only the names and the numbers of columns count
/// @throws InvalidInput for too many values per point, or a first point that LAS cannot hold
void checkLas(const Geometry& geometry, const std::vector<ResultArray>& arrays = {});

/// Names of the files of the last result in a folder, as its report.json lists them. Other files there belong to an
/// earlier result or are unrelated, and functions that read folders ignore them.
/// @throws IoError for a folder without a report.json that lists files
std::vector<std::string> filesOfResult(const std::filesystem::path& dir);

/// Reads the points of the last result in a folder: of a cloud's Laplacian points.pcd before points.ply, otherwise
/// points.ply before points.pcd; points.las is the last choice. Polygons and merged vertices are those that report.json
/// counts.
/// @return 0 points if the last result has neither
/// @throws IoError for the same reasons as filesOfResult() and read()
/// @throws Cancelled when `progress` returns false
Geometry readPoints(const std::filesystem::path& dir, const Progress& progress = {});

/// Reads what writeLaplacian() wrote with Format::npz: L.npz, M.npy, status.npy, representative.npy, boundary.npy,
/// frames.npy, noise.npy, component_edges.npy, and from report.json the kind and the Report. Files that report.json
/// does not list are ignored. Sign::igl and dummy values are undone. Results of versions without noise.npy and
/// component_edges.npy are read without noise, and with the report's mean edges for every component. `cover_areas` is M
/// if that holds the cover's areas, else empty. If report.json of an older version has no kind, it follows from the
/// options of the build there; without these a cover is refused, and nothing else depends on the kind.
///
/// What is read must be a Laplacian, by the rules of validate(): L is symmetric bit for bit, its off-diagonals are <= 0
/// and its rows sum to 0 within the rounding of their own sum; active points have a positive diagonal, all others no
/// entry and no mass; nothing is negative or not finite in M; a coincident point names an earlier one that stands for
/// itself. This is O(N), a fifth of the time of reading; the factorisation and the cover are left to validate().
///
/// L.npz and cover.npz may be deflated, by up to a factor of a thousand. Before their arrays are read, their sizes must
/// fit each other and the files of the points, which are not deflated. They are read in pieces: this takes 128 bytes
/// for each byte of the files, and four times the result.
/// @param with_cover whether to read cover.npz as well, if Format::cover was written; otherwise there is no cover
/// @throws IoError naming the file that is missing, damaged or does not fit the others, the entry that breaks a rule,
///         or the number of the report that does not fit its type
Laplacian readLaplacian(const std::filesystem::path& dir, bool with_cover = true);

/// Reads the files of readLaplacian() without checking that they hold a Laplacian, for validate(), which says how often
/// each promise is broken.
/// @throws IoError naming the file that is missing, damaged or does not fit the others
Laplacian readUncheckedLaplacian(const std::filesystem::path& dir, bool with_cover = true);

/// A checksum of L and M, which tells whether results belong to a Laplacian. Equal bits have equal checksums, however
/// they were built or written (Sign::igl and dummy values do not matter). It is no protection against forgery.
/// @return 16 hexadecimal digits
std::string checksum(const Laplacian& laplacian);

/// Reads the eigenpairs that `tufted spectrum` wrote: evals.npy, evecs.npy, and of report.json the checksum of the
/// Laplacian that they belong to.
/// @param laplacian the one they belong to, restricted to the components for which they were computed
/// @return SpectrumReport::method is "read", null_space counts the zeros among the eigenvalues, and residual is
/// measured again
/// @throws InvalidInput for arrays of the wrong size
/// @throws IoError naming the file that is missing, damaged or of another Laplacian, or whose vectors are not the
///         eigenvectors of the values
Spectrum readSpectrum(const std::filesystem::path& dir, const Laplacian& laplacian);

/// Reads an array of numbers of any type from a .npy file.
/// @return N x c, one column for an array of N values
/// @throws IoError naming the path, also for more than two dimensions
Eigen::MatrixXd readArray(const std::filesystem::path& path);

}  // namespace tufted
