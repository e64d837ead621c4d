#include "files.h"

#include <algorithm>
#include <deque>
#include <set>
#include <system_error>

#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace fs = std::filesystem;

namespace {

/// Lists a folder: its readable files into `found`, its folders to the front of `folders` and links to such to the end,
/// so that those come last. @returns why it cannot be listed, or an empty string
std::string list(const fs::path& folder, std::vector<Found>& found, std::deque<fs::path>& folders) {
  std::error_code error, ignored;
  std::vector<fs::directory_entry> entries;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator(); at.increment(error))
    entries.push_back(*at);
  std::sort(entries.begin(), entries.end());  // of two links to one folder the first counts
  for (const fs::directory_entry& entry : entries) {
    // A file that cannot be looked at is for the reader to refuse.
    if (!entry.is_directory(ignored)) {
      // Arrays of numpy are rarely points: results are such arrays.
      if (tufted::isReadable(entry.path()) && entry.path().extension() != ".npy") found.push_back({entry.path(), ""});
    } else if (entry.is_symlink(ignored)) {
      folders.push_back(entry.path());
    } else {
      folders.push_front(entry.path());
    }
  }
  return error ? "cannot list: " + error.message() : "";
}

std::vector<Found> filesBelow(const fs::path& top) {
  std::vector<Found> found;
  std::set<fs::path> seen;  // links may lead back
  std::deque<fs::path> folders = {top};
  while (!folders.empty()) {
    const fs::path folder = std::move(folders.front());
    folders.pop_front();
    std::error_code error;
    const fs::path canonical = fs::canonical(folder, error);
    if (!error && !seen.insert(canonical).second) continue;
    std::string refusal = list(folder, found, folders);
    if (!refusal.empty()) found.push_back({folder, std::move(refusal)});
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
    if (fs::is_directory(status)) {
      const std::vector<Found> below = filesBelow(path);
      found.insert(found.end(), below.begin(), below.end());
    } else {
      found.push_back({path, ""});
    }
    names += (names.empty() ? "" : ", ") + path.string();
  }
  if (found.empty() && !paths.empty())
    throw tufted::IoError(names + (paths.size() == 1 ? ": holds" : ": hold") + " no file of a known type");
  return found;
}
