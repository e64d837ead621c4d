#include "algorithms/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace tufted {
namespace {

using Path = std::filesystem::path;

/// The limit in bytes at the beginning of a file; SIZE_MAX if there is no number, as in "max".
std::size_t numberIn(const Path& path) {
  std::ifstream file(path);
  std::size_t number = 0;
  return file >> number ? number : SIZE_MAX;
}

/// The least limit of a control group and the groups that contain it.
std::size_t groupLimit(const Path& top, Path group, const char* name) {
  std::size_t least = numberIn(top / name);
  // In a container the path may be the host's and not visible; only the top counts then.
  for (; !group.empty(); group = group.parent_path()) least = std::min(least, numberIn(top / group / name));
  return least;
}

/// The limit of this process's control groups, from lines `number:controllers:/path`.
std::size_t groupsLimit(const Path& root) {
  const Path top = root / "sys/fs/cgroup";
  std::size_t least = SIZE_MAX;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
    const Path group = Path(line.substr(second + 1)).relative_path();
    if (controllers == ",,") least = std::min(least, groupLimit(top, group, "memory.max"));
    if (controllers.find(",memory,") != std::string::npos)
      least = std::min(least, groupLimit(top / "memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::size_t machineMemory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size) : SIZE_MAX;
}

/// MemAvailable: free memory and what caches can release.
std::size_t freeMemory(const Path& root) {
  std::ifstream file(root / "proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    std::size_t kilobytes = 0;
    if (words >> name >> kilobytes && name == "MemAvailable:") return 1024 * kilobytes;
  }
  return SIZE_MAX;
}

}  // namespace

std::size_t availableMemory(const Path& root) {
  return std::min({machineMemory(), freeMemory(root), groupsLimit(root)});
}

std::size_t memoryLimit(std::size_t option) {
  return option > 0 ? option : availableMemory() / 2;
}

}  // namespace tufted
