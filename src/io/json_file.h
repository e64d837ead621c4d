#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace tufted::io {

/// The JSON in a file; discarded where it is none. Nesting is bounded, because copies and texts of values recurse.
/// @throws IoError for a file that cannot be read or is nested deeper than 32 levels
nlohmann::json readJson(const std::filesystem::path& path);

}  // namespace tufted::io
