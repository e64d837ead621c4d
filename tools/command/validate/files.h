#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// A file to validate, or what `tufted laplacian` wrote into a folder, or a folder that holds neither.
struct Found {
  std::filesystem::path path;
  std::string refusal = {};  ///< of a folder: why it cannot be listed; else empty
  bool is_operator = false;  ///< the folder of --operator
};

/// What `paths` stand for, in their order: a file stands for itself, whatever its name, and a folder for the files
/// below it, sorted, that the readers know by their extension. Links to folders are followed; a folder that is reached
/// in several ways goes by one path, its own where it can.
/// @throws tufted::IoError where a path is missing, or there is nothing at all
std::vector<Found> findFiles(const std::vector<std::filesystem::path>& paths);
