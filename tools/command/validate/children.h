#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Runs this program once per list of arguments, `jobs` at a time, and checks 20 times a second for an interrupt. No
/// child process outlives the call.
/// @param ended called when a process ends, with the number of its list, the status of waitpid(), the seconds it took,
/// and what it wrote to stdout and stderr
/// @param wait called at each check
/// @throws tufted::Cancelled on Ctrl-C, SIGTERM and SIGHUP
void runChildren(const std::vector<std::vector<std::string>>& arguments, std::size_t jobs,
                 const std::function<void(std::size_t number, int status, double seconds, std::string text)>& ended,
                 const std::function<void()>& wait);
