#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// A file to validate, or a folder that cannot be listed.
struct Found {
  std::filesystem::path path;
  std::string refusal = {};  ///< why a folder cannot be listed
};

/// What `paths` stand for, in their order: a file for itself, whatever its name, and a folder for the files below it
/// that have the extension of a reader, sorted. Links to folders are followed; a folder that can be reached in several
/// ways counts once, by the path without links if there is one.
/// @throws tufted::IoError where a path is missing, or there is no file at all
std::vector<Found> findFiles(const std::vector<std::filesystem::path>& paths);
