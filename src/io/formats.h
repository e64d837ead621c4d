#pragma once

#include <filesystem>

#include "tufted/io/read.h"

namespace tufted::io {

/// One reader per format. All throw IoError naming the path and, where known, the line or byte.
Geometry readPcd(const std::filesystem::path& path);
Geometry readPly(const std::filesystem::path& path, bool with_faces);
Geometry readXyz(const std::filesystem::path& path);
Geometry readObj(const std::filesystem::path& path);
Geometry readOff(const std::filesystem::path& path);
Geometry readStl(const std::filesystem::path& path);

}  // namespace tufted::io
