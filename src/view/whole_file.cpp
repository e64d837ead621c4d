#include "view/whole_file.h"

#include <fcntl.h>
#include <stdlib.h>
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

/// The file that a path names, behind all links; it need not exist.
std::filesystem::path behindLinks(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error && status.type() != fs::file_type::not_found) refuse(path, error.value());  // as where links go in circles
  if (fs::is_directory(status)) throw IoError(path.string() + ": cannot write: is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw IoError(path.string() + ": cannot write: is no regular file");
  fs::path file = path;
  while (fs::is_symlink(fs::symlink_status(file, error))) {
    const fs::path next = fs::read_symlink(file, error);
    if (error) refuse(path, error.value());
    file = file.parent_path() / next;
  }
  return file;
}

/// A file in a hidden folder of its own beside the one that `path` names; both are removed again unless the file gets
/// its name.
class HiddenFile {
 public:
  explicit HiddenFile(const std::filesystem::path& path) : shown_(path), final_(behindLinks(path)) {
    folder_ = (final_.parent_path() / ".tufted-XXXXXX").string();
    if (::mkdtemp(folder_.data()) == nullptr) refuse(shown_, errno);
    name_ = folder_ + "/file";
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0) return;
    const int error = errno;
    ::rmdir(folder_.c_str());
    refuse(shown_, error);
  }
  HiddenFile(const HiddenFile&) = delete;
  HiddenFile& operator=(const HiddenFile&) = delete;
  ~HiddenFile() {
    if (file_ >= 0) ::close(file_);
    ::unlink(name_.c_str());  // which is gone where the file has its name
    ::rmdir(folder_.c_str());
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR) refuse(shown_, errno);
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void giveName() {
    if (::fsync(file_) != 0) refuse(shown_, errno);
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0 || ::rename(name_.c_str(), final_.c_str()) != 0) refuse(shown_, errno);
  }

 private:
  std::filesystem::path shown_, final_;
  std::string folder_, name_;
  int file_ = -1;
};

}  // namespace

void writeWholeFile(const std::filesystem::path& path, std::string_view bytes) {
  HiddenFile file(path);
  file.write(bytes);
  file.giveName();
}

}  // namespace tufted::view
