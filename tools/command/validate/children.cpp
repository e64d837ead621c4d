#include "children.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <list>
#include <system_error>
#include <utility>

#include "../interrupt.h"
#include "tufted/errors.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int milliseconds_between_looks = 50;

/// A running process of this program. The destructor kills it if it has not ended.
class Child {
 public:
  Child(std::size_t number, std::vector<std::string> arguments) : number_(number) {
    std::array<int, 2> ends = {};
    // Other children must not inherit the pipe, or it would stay open when this one ends.
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot open a pipe");
    output_ = ends[0];
    std::vector<char*> argv = {arguments.front().data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    // Not fork(), whose child has only the calling thread.
    const int error = posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error == 0) return;
    close(output_);
    throw std::system_error(error, std::generic_category(), "cannot start a process");
  }
  ~Child() {
    close(output_);
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int output() const { return output_; }
  std::size_t number() const { return number_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  std::string& text() { return text_; }

  /// Reads what it has written. Returns whether it has closed its output, as it does when it ends.
  bool read() {
    std::array<char, 1 << 16> part = {};
    const ssize_t count = ::read(output_, part.data(), part.size());
    if (count > 0) text_.append(part.data(), static_cast<std::size_t>(count));
    return count == 0;
  }
  int wait() {
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    return status;
  }

 private:
  const std::size_t number_;
  const Clock::time_point start_ = Clock::now();
  int output_ = -1;
  pid_t pid_ = 0;
  std::string text_;
};

}  // namespace

void runChildren(const std::vector<std::vector<std::string>>& arguments, std::size_t jobs,
                 const std::function<void(std::size_t, int, double, std::string)>& ended,
                 const std::function<void()>& wait) {
  std::list<Child> running;
  std::size_t next = 0;
  while (next < arguments.size() || !running.empty()) {
    if (interrupted()) throw tufted::Cancelled("cancelled");
    for (; next < arguments.size() && running.size() < jobs; ++next) running.emplace_back(next, arguments[next]);
    wait();
    std::vector<pollfd> outputs;
    for (const Child& child : running) outputs.push_back({child.output(), POLLIN, 0});
    poll(outputs.data(), outputs.size(), milliseconds_between_looks);
    auto output = outputs.begin();
    running.remove_if([&](Child& child) {
      if ((output++)->revents == 0 || !child.read()) return false;
      const int status = child.wait();
      ended(child.number(), status, child.seconds(), std::move(child.text()));
      return true;
    });
  }
}
