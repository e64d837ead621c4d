#pragma once

#include <filesystem>
#include <string_view>

namespace tufted::view {

/// Writes a file that appears whole or not at all: the bytes go beside `path` under a hidden name, which is then
/// changed. A file of that name is replaced; of a link, what it leads to.
/// @throws IoError naming `path`, also where it is no regular file, such as a device or a pipe; nothing is left then,
/// and a former file is as it was
void writeWholeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace tufted::view
