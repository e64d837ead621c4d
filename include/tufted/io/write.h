#pragma once

#include <filesystem>
#include <string>

#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Writes a Laplacian into the directory `dir`, which is made if missing:
///   L.npz               scipy.sparse.load_npz, csc
///   M.npy               float64, N
///   status.npy          uint8, N, see PointStatus
///   representative.npy  int32, N
///   boundary.npy        uint8, N, 0 or 1
///   report.json         the Report, with sign and scale stated
///   points.ply          binary copy of the points (and faces) with mass, boundary and status as fields
/// Every file is written under a temporary name and renamed, so that none is ever half there.
/// @throws IoError naming the path
void writeLaplacian(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry);

/// The report as JSON text (two-space indent).
std::string toJson(const Report& report);

}  // namespace tufted
