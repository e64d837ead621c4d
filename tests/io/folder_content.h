#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "temporary_dir.h"

/// What lies in a folder, hidden or not: the bytes of files by their names, "directory" for one.
inline std::map<std::string, std::string> contentOf(const std::filesystem::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    content[entry.path().filename().string()] = entry.is_directory() ? "directory" : readAll(entry.path());
  return content;
}
