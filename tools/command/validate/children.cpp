#include "children.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <list>
#include <system_error>
#include <thread>

#include "../interrupt.h"
#include "tufted/errors.h"

extern char** environ;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto tick = std::chrono::milliseconds(5);  // between two looks at the children and at Ctrl-C
constexpr off_t longest_output = 1 << 24;            // bytes of stdout that are kept, the last
constexpr off_t longest_error = 4096;                // of stderr

std::system_error systemError(int error, const char* what) {
  return {error, std::generic_category(), what};
}

/// A file in memory that a child writes to. Other children do not inherit it.
class Output {
 public:
  Output() : file_(memfd_create("output", MFD_CLOEXEC)) {
    if (file_ < 0) throw systemError(errno, "cannot make a file in memory");
  }
  ~Output() { close(file_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  int file() const { return file_; }

  std::string last(off_t most) const {
    const off_t size = lseek(file_, 0, SEEK_END), count = std::min(size, most);
    std::string text(static_cast<std::size_t>(count), '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, pread(file_, text.data(), text.size(), size - count))));
    return text;
  }

 private:
  const int file_;
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
    posix_spawn_file_actions_adddup2(&actions, out_.file(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.file(), STDERR_FILENO);
    // Not fork, which threads that wait for work do not survive.
    const int error = posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw systemError(error, "cannot start a process");
  }
  ~Child() {
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::size_t number() const { return number_; }

  /// Whether it has ended, and how. The memory that wait4 tells survives exec, and so includes ours.
  bool hasEnded(ChildEnd& end) {
    rusage usage = {};
    if (wait4(pid_, &end.status, WNOHANG, &usage) != pid_) return false;
    pid_ = 0;
    end.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    end.peak_memory = static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KB
    end.out = out_.last(longest_output);
    end.err = err_.last(longest_error);
    return true;
  }

 private:
  const std::size_t number_;
  const Clock::time_point start_;
  const Output out_, err_;
  pid_t pid_ = 0;
};

}  // namespace

void runChildren(const std::vector<std::vector<std::string>>& arguments, int jobs,
                 const std::function<void(std::size_t, ChildEnd)>& ended, const std::function<void()>& wait) {
  // Under a limit of memory OpenBLAS's threads look for room for ever, and the process cannot end.
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  std::list<Child> running;
  std::size_t next = 0;
  while (next < arguments.size() || !running.empty()) {
    if (interrupted()) throw tufted::Cancelled("cancelled");
    for (; next < arguments.size() && running.size() < static_cast<std::size_t>(jobs); ++next)
      running.emplace_back(next, arguments[next]);
    wait();
    std::this_thread::sleep_for(tick);
    running.remove_if([&ended](Child& child) {
      ChildEnd end;
      const bool has_ended = child.hasEnded(end);
      if (has_ended) ended(child.number(), std::move(end));
      return has_ended;
    });
  }
}
