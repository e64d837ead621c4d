#pragma once

#include <vector>

#include "io/staged_files.h"
#include "tufted/io/results.h"

namespace tufted::io {

/// Stages copies of the points with the arrays as fields, and report.json, as documented at writeResults().
void stageResults(StagedFiles& files, const Laplacian& laplacian, const Geometry& geometry,
                  const std::vector<ResultArray>& arrays, const ResultOptions& options);

}  // namespace tufted::io
