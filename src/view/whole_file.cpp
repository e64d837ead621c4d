#include "view/whole_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "tufted/errors.h"

namespace tufted::view {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw IoError(path.string() + ": cannot write: " + std::system_category().message(error));
}

/// The permissions of a new file, which mkstemp does not ask the process for.
mode_t permissions() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// A file that is removed again unless it is renamed.
class HiddenFile {
 public:
  explicit HiddenFile(const std::filesystem::path& path) : shown_(path) {
    name_ = (path.parent_path() / ("." + path.filename().string() + "-XXXXXX")).string();
    file_ = ::mkstemp(name_.data());
    if (file_ < 0) refuse(shown_, errno);
  }
  HiddenFile(const HiddenFile&) = delete;
  HiddenFile& operator=(const HiddenFile&) = delete;
  ~HiddenFile() {
    if (file_ >= 0) ::close(file_);
    if (!is_renamed_) ::unlink(name_.c_str());
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR) refuse(shown_, errno);
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void rename() {
    if (::fchmod(file_, permissions()) != 0 || ::fsync(file_) != 0) refuse(shown_, errno);
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0 || ::rename(name_.c_str(), shown_.c_str()) != 0) refuse(shown_, errno);
    is_renamed_ = true;
  }

 private:
  std::filesystem::path shown_;
  std::string name_;
  int file_ = -1;
  bool is_renamed_ = false;
};

}  // namespace

void writeWholeFile(const std::filesystem::path& path, std::string_view bytes) {
  HiddenFile file(path);
  file.write(bytes);
  file.rename();
}

}  // namespace tufted::view
