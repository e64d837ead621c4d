#include "io/open_path.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "io/errors.h"

namespace tufted::io {

OpenPath::OpenPath(const std::filesystem::path& path, int flags, const std::filesystem::path& shown)
    : shown_(shown), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags)) {
  if (file_ < 0) refuseErrno(shown_, "write", errno);
}

OpenPath::~OpenPath() {
  ::close(file_);
}

void OpenPath::sync() const {
  // Some file systems cannot flush a directory, and return EINVAL.
  if (::fsync(file_) != 0 && errno != EINVAL) refuseErrno(shown_, "write", errno);
}

void OpenPath::lock() const {
  while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

}  // namespace tufted::io
