#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace tufted::io {

/// Reads a file of JSON. The depth of nesting is bounded, because copying and printing values recurse.
/// @return the value; is_discarded() if the file is not valid JSON
/// @throws IoError for a file that cannot be read or is nested deeper than 32 levels
nlohmann::json readJson(const std::filesystem::path& path);

}  // namespace tufted::io
