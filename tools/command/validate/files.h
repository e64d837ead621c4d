#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// A file to validate, or a folder that cannot be listed.
struct Found {
  std::filesystem::path path;
  std::string refusal = {};  ///< why a folder cannot be listed
};

/// Finds the files that `paths` stand for, in their order: a file itself, whatever its name, or all files below a
/// folder with an extension that can be read, sorted. Links to folders are followed; a folder that is reached on
/// several ways counts once, by the path without links if there is one.
/// @throws tufted::IoError if a path is missing, or there is no file at all
std::vector<Found> findFiles(const std::vector<std::filesystem::path>& paths);
