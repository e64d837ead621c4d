#pragma once

#include <string>

#include "tufted/io/write.h"

namespace tufted::io {

/// The text of report.json: version, source, what was changed in reading it, options where given, conventions, report.
std::string reportJson(const Report& report, const Geometry& geometry, const WriteOptions& options);

}  // namespace tufted::io
