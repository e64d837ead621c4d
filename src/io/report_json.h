#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/conventions.h"
#include "tufted/io/write.h"

namespace tufted::io {

/// The text of a JSON value, for a file. Bytes that are not UTF-8, which paths may contain, become U+FFFD.
std::string jsonText(const nlohmann::ordered_json& json);

/// The text of a Laplacian's report.json: version, source, changes made in reading, options, files, conventions and
/// report.
/// @throws InvalidInput if options.build_options is no JSON object
std::string reportJson(const Laplacian& laplacian, const Geometry& geometry, const WriteOptions& options,
                       const std::vector<Convention>& conventions);

}  // namespace tufted::io
