#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/conventions.h"
#include "tufted/io/write.h"

namespace tufted::io {

/// The text of a file of JSON. Bytes that are not UTF-8, as paths may have, become U+FFFD.
std::string jsonText(const nlohmann::ordered_json& json);

/// The text of report.json of a Laplacian: version, source, what was changed in reading it, options, files,
/// conventions, report.
/// @throws InvalidInput if options.build_options is no JSON object
std::string reportJson(const Laplacian& laplacian, const Geometry& geometry, const WriteOptions& options,
                       const std::vector<Convention>& conventions);

}  // namespace tufted::io
