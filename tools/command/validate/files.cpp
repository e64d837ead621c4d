#include "files.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>

#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace fs = std::filesystem;

namespace {

/// Adds the files below a folder. Links to folders are appended to `links`, to be followed after everything else.
void addBelow(const fs::path& folder, std::set<fs::path>& seen, std::vector<fs::path>& links,
              std::vector<Found>& found) {
  std::error_code error, ignored;
  const fs::path canonical = fs::canonical(folder, error);
  if (!error && !seen.insert(canonical).second) return;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    const bool is_folder = at->is_directory(ignored);
    if (is_folder && at->is_symlink(ignored))
      links.push_back(*at);
    else if (is_folder)
      addBelow(*at, seen, links, found);
    else if (tufted::isReadable(*at) && at->path().extension() != ".npy")  // most arrays are results, not points
      found.push_back({*at});
  }
  if (error) found.push_back({folder, "cannot list: " + error.message()});
}

std::vector<Found> filesBelow(const fs::path& top) {
  std::vector<Found> found;
  std::set<fs::path> seen;  // folders visited, because links may form cycles
  for (std::vector<fs::path> folders = {top}; !folders.empty();) {
    std::vector<fs::path> links;
    for (const fs::path& folder : folders) addBelow(folder, seen, links, found);
    std::sort(links.begin(), links.end());  // so that of two links to one folder the first in this order counts
    folders = std::move(links);
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.path < b.path; });
  return found;
}

}  // namespace

std::vector<Found> findFiles(const std::vector<fs::path>& paths) {
  std::vector<Found> found;
  std::string names;
  for (const fs::path& path : paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw tufted::IoError(path.string() + ": no such file or folder");
    if (fs::is_directory(status))
      std::ranges::move(filesBelow(path), std::back_inserter(found));
    else
      found.push_back({path});
    names += (names.empty() ? "" : ", ") + path.string();
  }
  if (found.empty() && !paths.empty())
    throw tufted::IoError(names + (paths.size() == 1 ? ": holds" : ": hold") + " no file of a known type");
  return found;
}
