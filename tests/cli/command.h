#pragma once

#include <string>
#include <vector>

struct Result {
  int code = -1;  ///< exit code, or 128 + the signal that ended the process
  std::string out;
  std::string err;
};

/// Runs the command `tufted` with these arguments and waits for it. Neither stream is a terminal.
/// @param input a file to be its standard input
Result runTufted(const std::vector<std::string>& arguments, const std::string& input = "/dev/null");

/// Runs any program, found on the path; its arguments may name TUFTED_COMMAND.
Result runProgram(const std::vector<std::string>& words, const std::string& input = "/dev/null");

/// Runs it with a terminal as stderr, and sends SIGINT as soon as something appears there.
Result interruptTufted(const std::vector<std::string>& arguments);
