#pragma once

#include <filesystem>
#include <string_view>

#include "tufted/io/read.h"

namespace tufted::io {

/// One reader per format: the whole file is in `bytes`, `path` is for errors, `progress` for faces that are
/// triangulated. All throw IoError naming the path and, where known, the line or byte.
Geometry readPcd(const std::filesystem::path& path, std::string_view bytes);
Geometry readPly(const std::filesystem::path& path, std::string_view bytes, bool with_faces, const Progress& progress);
Geometry readXyz(const std::filesystem::path& path, std::string_view bytes);
Geometry readLas(const std::filesystem::path& path, std::string_view bytes);
Geometry readObj(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);
Geometry readOff(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);
Geometry readStl(const std::filesystem::path& path, std::string_view bytes);
Geometry readNpy(const std::filesystem::path& path, std::string_view bytes);
Geometry readVtk(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);

/// Whether the bytes begin as a file of that format does. Text of numbers is anything else that begins with numbers.
bool looksLikeVtk(std::string_view bytes);
bool looksLikePcd(std::string_view bytes);
bool looksLikeOff(std::string_view bytes);
bool looksLikeStl(std::string_view bytes);
bool looksLikeNpy(std::string_view bytes);
bool looksLikeObj(std::string_view bytes);
bool looksLikeXyz(std::string_view bytes);

}  // namespace tufted::io
