#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tufted {

/// A file that appears completely or not at all. The constructor flushes its bytes to disk in a hidden folder beside
/// it; giveName() renames it. Without that call it is removed, and an existing file of the name stays as it was. So it
/// can be known to be writable before other results are written.
class WholeFile {
 public:
  /// @param path of the file; if a link has this name, of the link's target. If its directory is still missing, the
  /// hidden folder is created in the nearest existing one above, and giveName() needs the directory.
  /// @param bytes content of the file
  /// @throws IoError naming `path`, also where it is no regular file, such as a device or a pipe
  WholeFile(const std::filesystem::path& path, std::string_view bytes);
  WholeFile(WholeFile&& other) noexcept;  ///< takes the file over; `other` then removes nothing
  WholeFile& operator=(WholeFile&&) = delete;
  ~WholeFile();

  /// Renames the file to its name, replacing an existing one. To be called once. @throws IoError naming the path
  void giveName();

 private:
  std::filesystem::path shown_, final_;
  std::string folder_;  ///< the hidden folder; empty once another object owns it
  std::string hidden_;  ///< the file in it
};

}  // namespace tufted
