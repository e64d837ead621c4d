#pragma once

#include <filesystem>

namespace tufted::io {

/// An open file or directory whose bytes are not wanted. Errors throw IoError: "path: cannot write: ...".
class OpenPath {
 public:
  /// @param flags of open(2) beside O_RDONLY and O_CLOEXEC
  /// @param shown the path to name in errors
  OpenPath(const std::filesystem::path& path, int flags, const std::filesystem::path& shown);
  ~OpenPath();
  OpenPath(const OpenPath&) = delete;
  OpenPath& operator=(const OpenPath&) = delete;

  /// Returns when what was written is on the disk; for a directory, the names that it has.
  void sync() const;
  /// Waits until no other process has the lock, which then is ours until this object ends. Does nothing where the
  /// file system has no locks.
  void lock() const;

 private:
  std::filesystem::path shown_;
  int file_;
};

}  // namespace tufted::io
