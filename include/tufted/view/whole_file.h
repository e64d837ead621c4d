#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tufted {

/// A file that appears whole or not at all. Its bytes are brought to the disk in a hidden folder beside it; giveName()
/// gives it its name. Without that it is removed, and a former file of the name is as it was. So one that belongs to
/// other results can be known to be good before these are written.
class WholeFile {
 public:
  /// @param path of the file; where a link has this name, of what it leads to. If its directory is still missing, the
  ///        hidden folder lies in the nearest one above, and giveName() needs the directory.
  /// @throws IoError naming `path`, also where it is no regular file, such as a device or a pipe
  WholeFile(const std::filesystem::path& path, std::string_view bytes);
  WholeFile(WholeFile&& other) noexcept;  ///< takes the file over; `other` then removes nothing
  WholeFile& operator=(WholeFile&&) = delete;
  ~WholeFile();

  /// Replaces a former file of the name. To be called once. @throws IoError naming the path
  void giveName();

 private:
  std::filesystem::path shown_, final_;
  std::string folder_;  ///< the hidden one; empty: it is another object's
  std::string hidden_;  ///< the file in it
};

}  // namespace tufted
