#include "tufted/io/read.h"

#include <algorithm>
#include <cctype>
#include <new>
#include <stdexcept>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/formats.h"

namespace tufted {
namespace {

Geometry readFormat(const std::filesystem::path& path, ReadAs as) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".pcd") return io::readPcd(path);
  if (extension == ".ply") return io::readPly(path, as != ReadAs::cloud);
  if (extension == ".obj") return io::readObj(path);
  if (extension == ".off") return io::readOff(path);
  if (extension == ".stl") return io::readStl(path);
  for (const char* text : {".xyz", ".xyzn", ".pwn", ".txt", ".csv", ".asc", ".pts"})
    if (extension == text) return io::readXyz(path);
  io::refuse(path, "unknown file type " + (extension.empty() ? "(no extension)" : io::quote(extension)) +
                       "; known are .pcd .ply .xyz .xyzn .pwn .txt .csv .asc .pts .obj .off .stl");
}

}  // namespace

Geometry read(const std::filesystem::path& path, ReadAs as) {
  io::fileSize(path);  // a missing file is the first thing to say
  try {
    Geometry geometry = readFormat(path, as);
    if (as == ReadAs::mesh && !geometry.is_mesh) io::refuse(path, "has no faces");
    if (as == ReadAs::cloud && geometry.is_mesh) {
      geometry.is_mesh = false;
      geometry.triangles.resize(0, 3);
      geometry.polygons = 0;
    }
    return geometry;
  } catch (const std::bad_alloc&) {
    io::refuse(path, "is too large for the memory");
  } catch (const std::length_error&) {
    io::refuse(path, "is too large for the memory");
  }
}

}  // namespace tufted
