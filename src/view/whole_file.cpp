#include "tufted/view/whole_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "tufted/errors.h"

namespace tufted {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw IoError(path.string() + ": cannot write: " + std::system_category().message(error));
}

/// Follows links to a file, which need not exist. @throws IoError if it is no regular file
std::filesystem::path behindLinks(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error && status.type() != fs::file_type::not_found) refuse(path, error.value());  // such as a cycle of links
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

void writeAll(int file, std::string_view bytes, const std::filesystem::path& shown) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) refuse(shown, errno);
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// The directory or, if it does not exist, the nearest one above it that does.
std::filesystem::path nearestDirectory(std::filesystem::path directory) {
  std::error_code error;
  while (!directory.empty() && !std::filesystem::exists(directory, error)) directory = directory.parent_path();
  return directory;
}

void removeHidden(const std::string& file, const std::string& folder) {
  ::unlink(file.c_str());  // fails if the file was renamed
  ::rmdir(folder.c_str());
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& path, std::string_view bytes)
    : shown_(path), final_(behindLinks(path)) {
  folder_ = (nearestDirectory(final_.parent_path()) / ".tufted-XXXXXX").string();
  constexpr std::string_view file_name = "/file";
  hidden_.reserve(folder_.size() + file_name.size());  // with no memory later, the folder would remain
  if (::mkdtemp(folder_.data()) == nullptr) refuse(shown_, errno);
  hidden_.append(folder_).append(file_name);
  const int file = ::open(hidden_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  try {
    if (file < 0) refuse(shown_, errno);
    writeAll(file, bytes, shown_);
    if (::fsync(file) != 0) refuse(shown_, errno);
  } catch (...) {
    if (file >= 0) ::close(file);
    removeHidden(hidden_, folder_);
    throw;
  }
  if (::close(file) == 0) return;
  const int error = errno;
  removeHidden(hidden_, folder_);
  refuse(shown_, error);
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      final_(std::move(other.final_)),
      folder_(std::exchange(other.folder_, {})),
      hidden_(std::move(other.hidden_)) {}

WholeFile::~WholeFile() {
  if (!folder_.empty()) removeHidden(hidden_, folder_);
}

void WholeFile::giveName() {
  if (::rename(hidden_.c_str(), final_.c_str()) != 0) refuse(shown_, errno);
}

}  // namespace tufted
