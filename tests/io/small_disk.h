#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <string>

#include "temporary_dir.h"

/// A disk of few bytes, in memory; only root may mount one.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& size)
      : is_mounted_(::mount("tmpfs", path().c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0) {}
  ~SmallDisk() {
    if (is_mounted_) ::umount2(path().c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool isMounted() const { return is_mounted_; }
  const std::filesystem::path& path() const { return dir_.path(); }
  std::filesystem::path operator/(std::string_view name) const { return path() / name; }

 private:
  TemporaryDir dir_;
  bool is_mounted_;
};
