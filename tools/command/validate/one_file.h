#pragma once

#include <filesystem>
#include <optional>

#include "../input.h"

/// A file to validate, or a folder that `tufted laplacian --out` wrote.
struct OneFile {
  std::filesystem::path path;
  bool is_operator = false;  ///< whether it is a folder
  tufted::ReadAs as = tufted::ReadAs::automatic;
  ChosenPoints chosen;
  int threads = 1;
  double seconds = 0;         ///< time limit, after which SIGALRM ends this process; 0: none
  std::optional<int> memory;  ///< limit of the memory that this process allocates, in MB
};

/// Reads, builds and checks a file, and prints the result as a line of JSON. For a process that does nothing else.
/// @return the exit code, exit_done also for a file that fails
int judge(const OneFile& file);
