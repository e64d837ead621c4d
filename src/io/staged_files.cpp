#include "io/staged_files.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <new>
#include <system_error>

#include "io/errors.h"
#include "tufted/errors.h"

namespace tufted::io {

namespace fs = std::filesystem;

namespace {

/// A file or directory opened only to sync or lock it. Errors throw IoError: "path: cannot write: ...".
class OpenPath {
 public:
  /// @param flags for open(2), in addition to O_RDONLY and O_CLOEXEC
  /// @param shown the path to name in errors
  OpenPath(const fs::path& path, int flags, const fs::path& shown)
      : shown_(shown), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags)) {
    if (file_ < 0) refuseErrno(shown_, "write", errno);
  }
  ~OpenPath() { ::close(file_); }
  OpenPath(const OpenPath&) = delete;
  OpenPath& operator=(const OpenPath&) = delete;

  /// Flushes the file's content, or the directory's names, to disk.
  void sync() const {
    // Some file systems cannot flush a directory, and return EINVAL.
    if (::fsync(file_) != 0 && errno != EINVAL) refuseErrno(shown_, "write", errno);
  }
  /// Waits for an exclusive lock, and holds it until this object is destroyed. Does nothing if the file system has no
  /// locks.
  void lock() const {
    while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }

 private:
  fs::path shown_;
  int file_;
};

/// Refuses a path that is a directory, a device, a pipe or a link, which renaming would replace.
void refuseOdd(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  if (type == fs::file_type::directory || fs::is_directory(path, error)) refuse(path, "cannot write: is a directory");
  if (type == fs::file_type::symlink) refuse(path, "cannot write: is a link, must be a file or missing");
  if (type != fs::file_type::regular && type != fs::file_type::not_found && type != fs::file_type::none)
    refuse(path, "cannot write: is no regular file");
}

}  // namespace

StagedFiles::StagedFiles(const fs::path& dir) : dir_(dir) {
  int attempts = 100;  // another process may make the directory and remove it again
  try {
    while (!makeHiddenFolder(attempts > 1)) --attempts;
    OpenPath(dir_, O_DIRECTORY, dir_);  // fails now instead of in commit()
  } catch (...) {
    removeHiddenFolder();
    removeMade();
    throw;
  }
}

StagedFiles::~StagedFiles() {
  removeHiddenFolder();
  removeMade();
}

bool StagedFiles::makeDirectory(bool may_vanish) {
  std::error_code error;
  made_.clear();
  // symlink_status(), because a link whose target is missing exists, and must not be removed later.
  for (auto missing = fs::absolute(dir_, error);
       fs::symlink_status(missing, error).type() == fs::file_type::not_found && missing.has_relative_path();
       missing = missing.parent_path())
    made_.insert(made_.begin(), missing);
  fs::create_directories(dir_, error);
  if (error) {
    removeMade();  // some parents may have been made
    // Another process removed a parent before a directory was made in it, or the directory after it was found to exist.
    const bool vanished = error == std::errc::no_such_file_or_directory || error == std::errc::file_exists;
    if (may_vanish && vanished) return false;
    refuse(dir_, "cannot make the directory: " + error.message());
  }
  const fs::file_status status = fs::status(dir_, error);
  if (may_vanish && status.type() == fs::file_type::not_found) return false;
  if (!fs::is_directory(status)) refuse(dir_, "is not a directory");
  return true;
}

bool StagedFiles::makeHiddenFolder(bool may_vanish) {
  if (!makeDirectory(may_vanish)) return false;
  std::string name = (dir_ / ".tufted-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    const int error = errno;
    removeMade();
    if (may_vanish && error == ENOENT) return false;
    refuseErrno(dir_, "write", error);
  }
  try {
    fs::path hidden = name;
    old_ = hidden / "old";
    hidden_.swap(hidden);
  } catch (const std::bad_alloc&) {
    ::rmdir(name.c_str());
    throw;
  }
  return true;
}

OutputPath StagedFiles::stage(const std::string& name) {
  OutputPath path = {hidden_ / name, dir_ / name};
  refuseOdd(path.shown);
  files_.push_back({path});
  return path;
}

std::vector<std::string> StagedFiles::names() const {
  std::vector<std::string> names;
  for (const File& file : files_) names.push_back(file.path.shown.filename().string());
  return names;
}

void StagedFiles::keepOld(File& file) {
  const char* const name = file.path.shown.c_str();
  refuseOdd(file.path.shown);  // another process may have made it since stage()
  // A hard link first, so that the name always refers to a file.
  file.has_old = ::linkat(AT_FDCWD, name, AT_FDCWD, file.old.c_str(), 0) == 0;
  if (file.has_old || errno == ENOENT) return;
  // Some file systems have no hard links, and files of other users may not be linked to.
  file.has_old = ::rename(name, file.old.c_str()) == 0;
  if (!file.has_old && errno != ENOENT) refuseErrno(file.path.shown, "write", errno);
}

void StagedFiles::removeName(const File& file) {
  if (::unlink(file.path.shown.c_str()) != 0 && errno != ENOENT) refuseErrno(file.path.shown, "write", errno);
}

void StagedFiles::place(File& file) {
  file.is_placed = ::rename(file.path.path.c_str(), file.path.shown.c_str()) == 0;
  if (!file.is_placed) refuseErrno(file.path.shown, "write", errno);
}

bool StagedFiles::putBack() {
  bool is_back = true;
  for (File& file : files_) {
    if (file.has_old)
      is_back &= ::rename(file.old.c_str(), file.path.shown.c_str()) == 0;
    else if (file.is_placed)
      is_back &= ::unlink(file.path.shown.c_str()) == 0;
  }
  return is_back;
}

void StagedFiles::syncParents() const {
  for (const fs::path& made : made_) {
    try {
      OpenPath(made.parent_path(), O_DIRECTORY, made).sync();
    } catch (const IoError&) {
      // A directory may be writable but not readable, and then cannot be opened.
    }
  }
}

void StagedFiles::commit() {
  for (File& file : files_) {
    OpenPath(file.path.path, O_NOFOLLOW, file.path.shown).sync();
    file.old = oldOf(file);
  }
  fs::path replaced = hidden_ / "replaced";
  const OpenPath dir(dir_, O_DIRECTORY, dir_);
  dir.lock();
  if (::mkdir(old_.c_str(), 0700) != 0) refuseErrno(dir_, "write", errno);
  try {
    for (File& file : files_) keepOld(file);
    if (!files_.empty()) removeName(files_.back());
    for (File& file : files_) place(file);
    dir.sync();
    syncParents();
  } catch (const std::exception& error) {
    if (putBack()) throw;  // takes no memory, of which there may be none
    hidden_.clear();       // keeps the hidden folder
    throw IoError(std::string(error.what()) + "; what was there before could not be put back from " + old_.string());
  }
  made_.clear();
  // old/ disappears in one step, as it marks an unfinished commit.
  if (::rename(old_.c_str(), replaced.c_str()) == 0) old_.swap(replaced);
}

void StagedFiles::removeHiddenFolder() noexcept {
  if (hidden_.empty()) return;
  // Only files known by name, so that no mistake can remove other files.
  for (const File& file : files_) ::unlink(file.path.path.c_str());
  const int old = ::open(old_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (old >= 0) {
    for (const File& file : files_) {
      const std::string& path = file.path.path.native();
      ::unlinkat(old, path.c_str() + path.rfind('/') + 1, 0);
    }
    ::close(old);
  }
  ::rmdir(old_.c_str());
  ::rmdir(hidden_.c_str());
}

void StagedFiles::removeMade() {
  std::error_code ignored;
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) fs::remove(*made, ignored);
}

}  // namespace tufted::io
