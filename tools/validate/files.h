#pragma once

#include <filesystem>
#include <vector>

/// The files that `paths` stand for, in their order: a file stands for itself, whatever its name, and a folder for the
/// files below it, sorted, that the readers know by their extension.
/// @throws tufted::IoError where a path is missing, a folder cannot be listed, or there is no file at all
std::vector<std::filesystem::path> findFiles(const std::vector<std::filesystem::path>& paths);
