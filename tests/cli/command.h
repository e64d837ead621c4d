#pragma once

#include <sys/types.h>

#include <csignal>
#include <string>
#include <vector>

struct Result {
  int code = -1;  ///< exit code, or 128 + the signal that ended the process
  std::string out;
  std::string err;
};

/// A running program. None of its streams is a terminal.
class Process {
 public:
  /// @param words the program, found by PATH, and its arguments
  /// @param input file that is its standard input
  Process(const std::vector<std::string>& words, const std::string& input);

  pid_t pid() const { return pid_; }
  /// Waits for the end. To be called once.
  Result finish();

 private:
  pid_t pid_ = 0;
  int out_ = -1, err_ = -1;
};

Process startTufted(const std::vector<std::string>& arguments, const std::string& input = "/dev/null");

/// Runs the command `tufted` and waits for it.
Result runTufted(const std::vector<std::string>& arguments, const std::string& input = "/dev/null");

std::string tuftedCommand();

/// Runs any program and waits for it.
Result runProgram(const std::vector<std::string>& words);

/// Runs the command with a terminal as stderr, and sends a signal as soon as a text appears there.
/// @param text for example the name of a stage; empty: any text
Result interruptTufted(const std::vector<std::string>& arguments, int signal = SIGINT, const std::string& text = "");

/// Runs the command with a terminal as stderr, and waits for it.
Result watchTufted(const std::vector<std::string>& arguments);
