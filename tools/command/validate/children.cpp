#include "children.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <list>
#include <string_view>
#include <system_error>
#include <vector>

#include "../interrupt.h"
#include "tufted/errors.h"

extern char** environ;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int tick = 100;                    // ms between two looks at Ctrl-C and its like
constexpr std::size_t longest_error = 4096;  // bytes of stderr that are kept

/// The environment of this process, but OpenBLAS starts no threads: under a limit of memory they look for room for
/// ever, and the process cannot end.
std::vector<char*> withoutBlasThreads() {
  static char one_thread[] = "OPENBLAS_NUM_THREADS=1";
  constexpr std::string_view name = "OPENBLAS_NUM_THREADS=";
  std::vector<char*> result = {one_thread};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::string_view(*variable).substr(0, name.size()) != name) result.push_back(*variable);
  result.push_back(nullptr);
  return result;
}

/// The two ends of a pipe. Neither is inherited by other children.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    close(ends_[0]);
    closeWriteEnd();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int readEnd() const { return ends_[0]; }
  int writeEnd() const { return ends_[1]; }
  void closeWriteEnd() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  /// Appends what has arrived. False once the other side is closed.
  bool readInto(std::string& text) const {
    char buffer[4096];
    for (;;) {
      const ssize_t count = read(ends_[0], buffer, sizeof(buffer));
      if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
      if (count == 0) return false;
      if (count < 0 && errno != EINTR) return errno == EAGAIN;
    }
  }

 private:
  int ends_[2] = {-1, -1};
};

/// A running child; killed when it goes out of scope before its end.
class Child {
 public:
  Child(std::size_t number, std::vector<std::string> arguments) : number_(number), start_(Clock::now()) {
    arguments.insert(arguments.begin(), "tufted");
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out_.writeEnd(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.writeEnd(), STDERR_FILENO);
    // Not fork, which threads that wait for work do not survive.
    std::vector<char*> environment = withoutBlasThreads();
    const int error = posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, argv.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start a process");
    out_.closeWriteEnd();
    err_.closeWriteEnd();
  }
  ~Child() {
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::size_t number() const { return number_; }
  bool timedOut() const { return end_.timed_out; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  pollfd output() const { return {out_.readEnd(), POLLIN, 0}; }
  pollfd errors() const { return {err_.readEnd(), POLLIN, 0}; }

  void timeOut() {
    end_.timed_out = true;
    kill(pid_, SIGKILL);
  }

  /// Takes what the child has written. True when it has ended.
  bool hasEnded() {
    const bool more_output = out_.readInto(end_.out), more_errors = err_.readInto(end_.err);
    if (end_.err.size() > longest_error) end_.err.erase(0, end_.err.size() - longest_error);
    return !more_output && !more_errors;
  }

  /// Waits for the end, which must be near. The memory that wait4 tells survives exec, and so includes ours.
  ChildEnd end() {
    rusage usage = {};
    while (wait4(pid_, &end_.status, 0, &usage) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    end_.seconds = seconds();
    end_.peak_memory = static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KB
    return std::move(end_);
  }

 private:
  std::size_t number_;
  Clock::time_point start_;
  Pipe out_, err_;
  pid_t pid_ = 0;
  ChildEnd end_;
};

/// Sleeps until a child writes or ends, or until it is time to look at the clock.
void waitForAny(const std::list<Child>& running, double seconds) {
  std::vector<pollfd> files;
  files.reserve(2 * running.size());
  double nearest = tick;
  for (const Child& child : running) {
    files.push_back(child.output());
    files.push_back(child.errors());
    if (seconds > 0 && !child.timedOut()) nearest = std::min(nearest, 1000 * (seconds - child.seconds()));
  }
  poll(files.data(), files.size(), std::max(0, static_cast<int>(std::ceil(nearest))));
}

}  // namespace

void runChildren(const std::vector<std::vector<std::string>>& arguments, int jobs, double seconds,
                 const std::function<void(std::size_t, ChildEnd)>& ended, const std::function<void()>& wait) {
  std::list<Child> running;
  std::size_t next = 0;
  while (next < arguments.size() || !running.empty()) {
    if (interrupted()) throw tufted::Cancelled("cancelled");
    for (; next < arguments.size() && running.size() < static_cast<std::size_t>(jobs); ++next)
      running.emplace_back(next, arguments[next]);
    wait();
    waitForAny(running, seconds);
    for (auto child = running.begin(); child != running.end();) {
      if (child->hasEnded()) {
        ended(child->number(), child->end());
        child = running.erase(child);
        continue;
      }
      if (seconds > 0 && child->seconds() > seconds && !child->timedOut()) child->timeOut();
      ++child;
    }
  }
}
