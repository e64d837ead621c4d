#pragma once

#include <string>
#include <vector>

#include "io/conventions.h"
#include "tufted/io/write.h"

namespace tufted::io {

/// The text of report.json: version, source, what was changed in reading it, options, conventions, report.
std::string reportJson(const Laplacian& laplacian, const Geometry& geometry, const WriteOptions& options,
                       const std::vector<Convention>& conventions);

}  // namespace tufted::io
