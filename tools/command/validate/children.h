#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Runs this program once per list of arguments, `jobs` at a time, and looks 20 times a second whether it was
/// interrupted.
/// @param ended is called in the order in which the processes end, with the number of the list, the status of
/// waitpid(), the seconds it took, and what the process wrote to stdout and stderr
/// @param wait is called with each look
/// @throws tufted::Cancelled on Ctrl-C, SIGTERM and SIGHUP. However it leaves, no child is left behind.
void runChildren(const std::vector<std::vector<std::string>>& arguments, std::size_t jobs,
                 const std::function<void(std::size_t number, int status, double seconds, std::string text)>& ended,
                 const std::function<void()>& wait);
