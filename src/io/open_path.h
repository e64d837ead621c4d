#pragma once

#include <filesystem>

namespace tufted::io {

/// A file or directory opened only to sync or lock it. Errors throw IoError: "path: cannot write: ...".
class OpenPath {
 public:
  /// @param flags for open(2), in addition to O_RDONLY and O_CLOEXEC
  /// @param shown the path to name in errors
  OpenPath(const std::filesystem::path& path, int flags, const std::filesystem::path& shown);
  ~OpenPath();
  OpenPath(const OpenPath&) = delete;
  OpenPath& operator=(const OpenPath&) = delete;

  /// Flushes the file's content, or the directory's names, to disk.
  void sync() const;
  /// Waits for an exclusive lock, and holds it until this object is destroyed. Does nothing if the file system has no
  /// locks.
  void lock() const;

 private:
  std::filesystem::path shown_;
  int file_;
};

}  // namespace tufted::io
