#include "files.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, error);
  // A file that cannot be looked at is for the reader to refuse.
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_directory(ignored) && tufted::isReadable(entry->path())) files.push_back(entry->path());
  }
  if (error) throw tufted::IoError(folder.string() + ": cannot list: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<fs::path> findFiles(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw tufted::IoError(path.string() + ": no such file or folder");
    if (fs::is_directory(status)) {
      const std::vector<fs::path> below = filesBelow(path);
      files.insert(files.end(), below.begin(), below.end());
    } else {
      files.push_back(path);
    }
  }
  if (files.empty()) throw tufted::IoError(paths.front().string() + ": holds no file of a known type");
  return files;
}
