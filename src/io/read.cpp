#include "tufted/io/read.h"

#include <istream>
#include <new>
#include <stdexcept>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/file_text.h"
#include "io/formats.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

struct Extension {
  const char* name;
  FileFormat format;
};

constexpr Extension extensions[] = {
    {".pcd", FileFormat::pcd},  {".ply", FileFormat::ply},  {".xyz", FileFormat::xyz}, {".xyzn", FileFormat::xyz},
    {".pwn", FileFormat::xyz},  {".txt", FileFormat::xyz},  {".csv", FileFormat::xyz}, {".asc", FileFormat::xyz},
    {".pts", FileFormat::xyz},  {".las", FileFormat::las},  {".obj", FileFormat::obj}, {".off", FileFormat::off},
    {".coff", FileFormat::off}, {".noff", FileFormat::off}, {".stl", FileFormat::stl}, {".npy", FileFormat::npy},
    {".vtk", FileFormat::vtk},
};

FileFormat formatByExtension(const std::filesystem::path& path) {
  const std::string extension = io::lower(path.extension().string());
  for (const Extension& known : extensions)
    if (extension == known.name) return known.format;
  return FileFormat::automatic;
}

FileFormat formatByContent(std::string_view bytes) {
  if (const std::string start = io::lower(bytes.substr(0, 4)); start == "ply\n" || start == "ply\r")
    return FileFormat::ply;
  if (bytes.starts_with("LASF")) return FileFormat::las;
  if (io::looksLikeNpy(bytes)) return FileFormat::npy;
  if (io::looksLikeVtk(bytes)) return FileFormat::vtk;
  if (io::looksLikePcd(bytes)) return FileFormat::pcd;
  if (io::looksLikeOff(bytes)) return FileFormat::off;
  if (io::looksLikeStl(bytes)) return FileFormat::stl;
  if (io::looksLikeObj(bytes)) return FileFormat::obj;
  if (io::looksLikeXyz(bytes)) return FileFormat::xyz;
  return FileFormat::automatic;
}

Geometry readFormat(const std::filesystem::path& path, std::string_view bytes, bool with_faces, FileFormat format,
                    const Progress& progress) {
  switch (format) {
    case FileFormat::pcd:
      return io::readPcd(path, bytes);
    case FileFormat::ply:
      return io::readPly(path, bytes, with_faces, progress);
    case FileFormat::las:
      return io::readLas(path, bytes);
    case FileFormat::obj:
      return io::readObj(path, bytes, progress);
    case FileFormat::off:
      return io::readOff(path, bytes, progress);
    case FileFormat::stl:
      return io::readStl(path, bytes);
    case FileFormat::npy:
      return io::readNpy(path, bytes);
    case FileFormat::vtk:
      return io::readVtk(path, bytes, progress);
    case FileFormat::xyz:
    case FileFormat::automatic:
      break;
  }
  return io::readXyz(path, bytes);
}

[[noreturn]] void refuseFormat(const std::filesystem::path& path) {
  const std::string extension = io::lower(path.extension().string());
  std::string names;
  for (const Extension& known : extensions) names += std::string(" ") + known.name;
  io::refuseByte(path, 0,
                 "unknown file type " + (extension.empty() ? "(no extension)" : io::quote(extension)) +
                     ", and the content begins like none; known are" + names);
}

/// Runs `work`. @throws FileTooLarge naming the path when memory does not suffice
template <class Work>
Geometry withinMemory(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw FileTooLarge(path.string() + ": is too large for the memory");
  } catch (const std::length_error&) {
    throw FileTooLarge(path.string() + ": is too large for the memory");
  }
}

}  // namespace

FileFormat io::formatOf(const std::filesystem::path& path, std::string_view bytes) {
  const FileFormat format = formatByExtension(path);
  return format == FileFormat::automatic ? formatByContent(bytes) : format;
}

Geometry parse(std::string_view bytes, const std::filesystem::path& name, ReadAs as, FileFormat format,
               const Progress& progress) {
  return withinMemory(name, [&] {
    if (bytes.empty()) io::refuse(name, "is empty");
    if (format == FileFormat::automatic) format = io::formatOf(name, bytes);
    if (format == FileFormat::automatic) refuseFormat(name);
    Geometry geometry = readFormat(name, bytes, as != ReadAs::cloud, format, progress);
    if (as == ReadAs::mesh && !geometry.is_mesh) io::refuse(name, "has no faces");
    if (as == ReadAs::cloud && geometry.is_mesh) {
      geometry.is_mesh = false;
      geometry.triangles.resize(0, 3);
      geometry.polygons = 0;
    }
    return geometry;
  });
}

Geometry read(const std::filesystem::path& path, ReadAs as, FileFormat format, const Progress& progress) {
  return withinMemory(path, [&] { return parse(io::readBytes(path), path, as, format, progress); });
}

Geometry read(std::istream& stream, const std::string& name, ReadAs as, FileFormat format, const Progress& progress) {
  return withinMemory(name, [&] {
    std::string bytes;
    for (char block[1 << 16]; stream.read(block, sizeof(block)) || stream.gcount() > 0;)
      bytes.append(block, static_cast<std::size_t>(stream.gcount()));
    if (stream.bad()) io::refuse(name, "cannot be read");
    return parse(bytes, name, as, format, progress);
  });
}

bool isReadable(const std::filesystem::path& path) {
  return formatByExtension(path) != FileFormat::automatic;
}

}  // namespace tufted
