#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// How a child process ended.
struct ChildEnd {
  int status = 0;          ///< as of waitpid
  double seconds = 0;      ///< wall-clock
  double peak_memory = 0;  ///< MB, but no less than this process had when it started the child
  std::string out;         ///< what it wrote to stdout
  std::string err;         ///< the last it wrote to stderr
};

/// Runs this program once per list of arguments, at most `jobs` at a time. Calls `ended` with the number of the list,
/// in the order in which the children end, and `wait` many times a second.
/// @throws tufted::Cancelled on Ctrl-C, SIGTERM and SIGHUP. However it leaves, no child is left behind.
void runChildren(const std::vector<std::vector<std::string>>& arguments, int jobs,
                 const std::function<void(std::size_t, ChildEnd)>& ended, const std::function<void()>& wait);
