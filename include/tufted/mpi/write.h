#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// An array of a result.
struct DistributedArray {
  std::string name;                                          ///< of the file, without .npy
  std::vector<Vec> columns;                                  ///< one value per row of L each
  double absent = std::numeric_limits<double>::quiet_NaN();  ///< value of points that are not active
};

/// What a result on several processes has.
struct DistributedResult {
  std::vector<DistributedArray> arrays = {};  ///< NAME.npy each: N values, or N x c, float64, see valuesByPoint()
  std::vector<std::pair<std::string, std::vector<double>>> lists = {};  ///< NAME.npy each, the same in all processes
  bool has_matrices = false;  ///< L.petsc and M.petsc, PETSc's binary files; row.npy: N rows, int64, -1: not active
  std::string report = "{}";  ///< members of report.json, a JSON object, the same in all processes
};

/// Writes a result into the directory `dir`, which is created if missing. All files appear together, as with
/// writeLaplacian(); process 0 writes all but the matrices, and no process holds an array as a whole. Collective.
/// @throws InvalidInput for a report that is no JSON object
/// @throws IoError naming the path, possibly in process 0 alone while others wait: end all with MPI_Abort() then
void writeDistributed(const std::filesystem::path& dir, const DistributedLaplacian& laplacian,
                      const DistributedResult& result);

}  // namespace tufted
