#pragma once

#include <string>

#include "tufted/io/write.h"

namespace tufted::io {

/// The text of report.json: version, conventions, source, options where given, report.
std::string reportJson(const Report& report, const WriteOptions& options);

}  // namespace tufted::io
