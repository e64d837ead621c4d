#pragma once

#include <vector>

#include "io/staged_files.h"
#include "tufted/io/results.h"

namespace tufted::io {

/// Stages copies of the points with the arrays as fields, and report.json, as documented at writeResults().
void stageResults(StagedFiles& files, const Laplacian& laplacian, const Geometry& geometry,
                  const std::vector<ResultArray>& arrays, const ResultOptions& options);

inline constexpr const char* file_row_name = "file_row.npy";
/// The field that select() adds; nullptr if a geometry has none.
const Field* fileRowOf(const Geometry& geometry);
/// Stages file_row.npy if a geometry has that field.
void stageFileRow(StagedFiles& files, const Geometry& geometry);

}  // namespace tufted::io
