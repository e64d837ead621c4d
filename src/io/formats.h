#pragma once

#include <filesystem>
#include <string_view>

#include "tufted/io/read.h"

namespace tufted::io {

/// Readers, one per format.
/// @param path for errors
/// @param bytes the whole file
/// @param progress called while faces are triangulated
/// @throws IoError naming the path and, where known, the line or byte
Geometry readPcd(const std::filesystem::path& path, std::string_view bytes);
Geometry readPly(const std::filesystem::path& path, std::string_view bytes, bool with_faces, const Progress& progress);
Geometry readXyz(const std::filesystem::path& path, std::string_view bytes);
Geometry readLas(const std::filesystem::path& path, std::string_view bytes);
Geometry readObj(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);
Geometry readOff(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);
Geometry readStl(const std::filesystem::path& path, std::string_view bytes);
Geometry readNpy(const std::filesystem::path& path, std::string_view bytes);
Geometry readVtk(const std::filesystem::path& path, std::string_view bytes, const Progress& progress);

/// The format of a file by its extension, or if that is unknown by its content; `automatic` if both are unknown.
/// @param bytes the whole file; its beginning suffices for PLY, LAS, NPY, VTK and PCD
FileFormat formatOf(const std::filesystem::path& path, std::string_view bytes);

/// Whether the bytes begin like a file of this format. looksLikeXyz() is asked last, as any text of numbers passes it.
bool looksLikeVtk(std::string_view bytes);
bool looksLikePcd(std::string_view bytes);
bool looksLikeOff(std::string_view bytes);
bool looksLikeStl(std::string_view bytes);
bool looksLikeNpy(std::string_view bytes);
bool looksLikeObj(std::string_view bytes);
bool looksLikeXyz(std::string_view bytes);

}  // namespace tufted::io
