#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Number type of a field, as PCD and PLY name them (64-bit integers: PCD only).
enum class FieldType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// A further value per point that the file carries (colour, intensity, label, ...), kept as it was stored.
struct Field {
  std::string name;                     ///< as in the file, but see fieldKey()
  FieldType type = FieldType::float32;  ///< of one value
  int count = 1;                        ///< values per point
  std::vector<std::byte> bytes;         ///< N * count values, native byte order
};

/// Value i of the N * count values of a field. 64-bit integers beyond 2^53 are rounded.
double valueOf(const Field& field, std::size_t i);

/// What a field is called here, whatever program wrote the file: `x` for "X", "Points_m_XYZ:0" and Easting, `nx` for
/// normal_x, `red` for R and diffuse_red, `gps_time` for GpsTime. Other names are lower case and one word, without
/// quotes. Readers name the fields so that they know; what else a file names keeps its capitals.
std::string fieldKey(std::string_view name);

/// Which of `names` somebody means by `name`: the same, or else the first that differs in capitals alone, or else of
/// the same fieldKey(); -1 for none.
std::ptrdiff_t findField(const std::vector<std::string>& names, const std::string& name);

/// What a file holds: a cloud, or a mesh.
struct Geometry {
  std::string format;         ///< format of the file, for people: "PCD, binary", "LAS 1.4, point format 6"
  Points points;              ///< N x 3, in the file's unit, float and double without loss
  Points normals;             ///< N x 3 where the file has them, else 0 x 3
  std::vector<Field> fields;  ///< everything else per point, in the file's order
  int width = 0;              ///< columns of an organized cloud; N otherwise
  int height = 1;             ///< rows of an organized cloud; 1 otherwise
  /// Pose of the sensor as PCD states it: translation x y z, then the quaternion w x y z, of any length but 0. All
  /// seven numbers are finite: readers refuse other files, writers other poses.
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  bool is_mesh = false;              ///< false: a cloud
  Triangles triangles;               ///< F x 3; polygons are triangulated, in order
  std::int64_t polygons = 0;         ///< faces of more than three corners that were triangulated
  std::int64_t merged_vertices = 0;  ///< corners of an STL that became one vertex with an equal earlier one
  std::int64_t unread_bytes = 0;     ///< behind the last record that the file counts; they are passed over
  std::vector<std::string> notes;    ///< what was passed over or changed: a line each, beginning with the path
};

/// Whether to read a file as a cloud or as a mesh.
enum class ReadAs {
  automatic,  ///< a mesh where the file has faces, else a cloud: an OBJ or OFF without faces too
  cloud,      ///< points only; faces are ignored
  mesh,       ///< a file without faces is an error
};

/// The formats that are read. Text of numbers in columns, whatever its name, is `xyz`.
enum class FileFormat { automatic, pcd, ply, xyz, las, obj, off, stl, npy, vtk };

/// Reads clouds (PCD, PLY, XYZ, LAS, OFF and OBJ without faces, NPY of N x 3 numbers or more, or with names) and meshes
/// (PLY, OBJ, OFF, STL, VTK's legacy polygonal data).
///
/// Bytes behind the last record that a file counts are passed over and noted; a file that counts no record must have
/// none. The counts that a file announces are compared with its size before memory is taken for them. Reading takes
/// less than 128 bytes for each byte of the file and twice what is returned.
/// @param format `automatic` goes by the extension, and where that is unknown by the content.
/// @param progress called while polygons of many corners are triangulated
/// @throws FileTooLarge when the memory does not suffice
/// @throws IoError naming the path, and the line or byte where known
/// @throws Cancelled when `progress` returns false
Geometry read(const std::filesystem::path& path, ReadAs as = ReadAs::automatic,
              FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Reads a stream to its end, such as std::cin.
/// @param name stands for the path in errors
/// @param format `automatic` goes by the content.
Geometry read(std::istream& stream, const std::string& name, ReadAs as = ReadAs::automatic,
              FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Reads a file that is in memory already.
/// @param name stands for the path; its extension counts as that of a path does.
Geometry parse(std::string_view bytes, const std::filesystem::path& name, ReadAs as = ReadAs::automatic,
               FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Whether `read` knows this type of file. Looks at the extension alone.
bool isReadable(const std::filesystem::path& path);

}  // namespace tufted
