#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <stdexcept>

/// While this lives, the process and those that it starts get no more of a resource (getrlimit(2)) than `most`.
class ResourceLimit {
 public:
  ResourceLimit(decltype(RLIMIT_AS) resource, rlim_t most) : resource_(resource) {
    getrlimit(resource, &before_);
    const rlimit limit = {most, before_.rlim_max};
    if (setrlimit(resource, &limit) != 0) throw std::runtime_error("the limit cannot be set");
  }
  ~ResourceLimit() { setrlimit(resource_, &before_); }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;

 private:
  decltype(RLIMIT_AS) resource_;
  rlimit before_ = {};
};

/// While this lives, no file grows beyond `bytes`: stands for a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)), limit_(RLIMIT_FSIZE, bytes) {}
  ~FileSizeLimit() { std::signal(SIGXFSZ, handler_); }

 private:
  void (*handler_)(int);
  ResourceLimit limit_;
};

/// Bytes of addresses that this process has now.
inline rlim_t addressBytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}
