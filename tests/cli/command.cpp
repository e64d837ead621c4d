#include "command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

extern char** environ;

namespace {

// Not by fork(), whose child has only the calling thread.
pid_t spawn(std::vector<std::string> words, int in, int out, int err) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
  // The command starts with default signals, even if the tests run under nohup.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, words[0].c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::runtime_error("cannot start " + words[0]);
  return pid;
}

std::vector<std::string> withCommand(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {tuftedCommand()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

int wait(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Appends what can be read. Returns false at the end.
bool readSome(int file, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(file, buffer, sizeof(buffer));
  if (count <= 0) return false;
  text.append(buffer, static_cast<std::size_t>(count));
  return true;
}

}  // namespace

Process::Process(const std::vector<std::string>& words, const std::string& input) {
  const int in = open(input.c_str(), O_RDONLY | O_CLOEXEC);
  if (in < 0) throw std::runtime_error("cannot open " + input);
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  pid_ = spawn(words, in, out[1], err[1]);
  close(in);
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

Result Process::finish() {
  Result result;
  pollfd files[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    poll(files, 2, -1);
    for (pollfd& file : files)
      if (file.revents != 0 && !readSome(file.fd, file.fd == out_ ? result.out : result.err)) file.fd = -1;
  }
  close(out_);
  close(err_);
  result.code = wait(pid_);
  return result;
}

std::string tuftedCommand() {
  return TUFTED_COMMAND;
}

Process startTufted(const std::vector<std::string>& arguments, const std::string& input) {
  return Process(withCommand(arguments), input);
}

Result runTufted(const std::vector<std::string>& arguments, const std::string& input) {
  return startTufted(arguments, input).finish();
}

Result runProgram(const std::vector<std::string>& words) {
  return Process(words, "/dev/null").finish();
}

Result interruptTufted(const std::vector<std::string>& arguments, int signal, const std::string& text) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) throw std::runtime_error("no terminal");
  const int err = open(ptsname(terminal), O_RDWR | O_NOCTTY | O_CLOEXEC);
  const int out = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t pid = spawn(withCommand(arguments), in, out, err);
  close(in);
  close(out);
  close(err);
  Result result;
  for (bool sent = false; readSome(terminal, result.err);) {
    if (sent || result.err.find(text) == std::string::npos) continue;
    kill(pid, signal);
    sent = true;
  }
  close(terminal);
  result.code = wait(pid);
  return result;
}

Result watchTufted(const std::vector<std::string>& arguments) {
  return interruptTufted(arguments, 0);  // signal 0 does nothing
}
