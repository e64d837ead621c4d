#pragma once

#include <filesystem>
#include <optional>

#include "tufted/io/read.h"

/// A file to validate, or the folder that `tufted laplacian --out` wrote.
struct OneFile {
  std::filesystem::path path;
  bool is_operator = false;  ///< a folder
  tufted::ReadAs as = tufted::ReadAs::automatic;
  int threads = 1;
  double seconds = 0;         ///< this process ends after so many by SIGALRM; 0: no limit
  std::optional<int> memory;  ///< limit in MB of what this process allocates
};

/// Reads, builds, checks, and prints what it found as a line of JSON. For a process that does nothing else.
/// @returns the exit code, that of a file that fails is exit_done, too
int judge(const OneFile& file);
