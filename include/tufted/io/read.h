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
#include "tufted/scan_structure.h"
#include "tufted/types.h"

namespace tufted {

/// Number type of a field, as PCD and PLY name them (64-bit integers: PCD only).
enum class FieldType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// A further value per point of the file (colour, intensity, label, ...), kept as it was stored.
struct Field {
  std::string name;                     ///< as in the file, or as fieldKey() makes it
  FieldType type = FieldType::float32;  ///< type of one value
  int count = 1;                        ///< values per point
  std::vector<std::byte> bytes;         ///< N * count values, point by point, native byte order
};

/// Value i of the N * count values of a field, 0 <= i. 64-bit integers beyond 2^53 are rounded.
double valueOf(const Field& field, std::size_t i);

/// Whether a field is a colour that PCL packed as 0xAARRGGBB into four bytes: one value `rgb` or `rgba` per point.
bool isPackedColor(const Field& field);

/// The name by which the library knows a field, whatever program wrote the file: `x` for "X", "Points_m_XYZ:0" and
/// Easting, `nx` for normal_x, `red` for R and diffuse_red, `gps_time` for GpsTime. Other names become one word in
/// lower case without quotes. Readers give such names to the fields they know; all others keep their capitals.
std::string fieldKey(std::string_view name);

/// Finds a name among `names`: the equal one, or else the first that differs only in capitals, or else the first with
/// the same fieldKey().
/// @return index in `names`; -1: none
std::ptrdiff_t findField(const std::vector<std::string>& names, const std::string& name);

/// The content of a file: a cloud, or a mesh.
struct Geometry {
  std::string format;         ///< format of the file, for people: "PCD, binary", "LAS 1.4, point format 6"
  Points points;              ///< N x 3, in the file's unit; floats and doubles are read without loss
  Points normals;             ///< N x 3 if the file has them, else 0 x 3
  std::vector<Field> fields;  ///< everything else per point, in the file's order
  int width = 0;              ///< columns of an organized cloud; N otherwise
  int height = 1;             ///< rows of an organized cloud; 1 otherwise
  /// Pose of the sensor as PCD states it: translation x y z, then the quaternion w x y z, of any length but 0. All
  /// seven numbers are finite: readers refuse other files, writers other poses.
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  bool is_mesh = false;              ///< whether the file has faces that were read
  Triangles triangles;               ///< F x 3; polygons are triangulated, in order
  std::int64_t polygons = 0;         ///< faces of more than three corners that were triangulated
  std::int64_t merged_vertices = 0;  ///< corners of an STL that were merged with an earlier equal one
  std::int64_t unread_bytes = 0;     ///< bytes behind the last record that the file announces; they are skipped
  std::vector<std::string> notes;    ///< what was skipped or changed: a line each, beginning with the path
  /// The header of a LAS file and its variable length records, such as the coordinate reference system. From these
  /// Format::las writes points.las with the same scale and offset. It is empty for other files.
  std::string las_header;
};

/// Whether to read a file as a cloud or as a mesh.
enum class ReadAs {
  automatic,  ///< a mesh if the file has faces, otherwise a cloud, for OBJ and OFF too
  cloud,      ///< points only; faces are ignored
  mesh,       ///< a file without faces is an error
};

/// The formats that can be read. Text with numbers in columns, whatever its name, is `xyz`.
enum class FileFormat { automatic, pcd, ply, xyz, las, obj, off, stl, npy, vtk };

/// Reads a cloud (PCD, PLY, XYZ, LAS, OFF and OBJ without faces, NPY of N x 3 numbers or more, or with names) or a mesh
/// (PLY, OBJ, OFF, STL, VTK's legacy polygonal data) from a file.
///
/// Bytes behind the last record that a file announces are skipped and noted; a file that announces no records must have
/// none. Announced counts are compared with the size of the file before memory is taken for them. Reading takes less
/// than 128 bytes of memory for each byte of the file and twice the result.
/// @param format `automatic` decides by the extension, and if that is unknown by the content
/// @param progress called while polygons of many corners are triangulated
/// @throws FileTooLarge when memory does not suffice
/// @throws IoError naming the path, and the line or byte where known; also for ReadAs::mesh without faces
/// @throws Cancelled when `progress` returns false
Geometry read(const std::filesystem::path& path, ReadAs as = ReadAs::automatic,
              FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Reads a stream, such as std::cin, to its end; otherwise as from a file.
/// @param name used as the path: in errors, and its extension for `automatic`
Geometry read(std::istream& stream, const std::string& name, ReadAs as = ReadAs::automatic,
              FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Reads the bytes of a file; otherwise as from a file.
/// @param name used as the path: in errors, and its extension for `automatic`
Geometry parse(std::string_view bytes, const std::filesystem::path& name, ReadAs as = ReadAs::automatic,
               FileFormat format = FileFormat::automatic, const Progress& progress = {});

/// Whether read() knows the extension of a path. The file is not opened.
bool isReadable(const std::filesystem::path& path);

/// Finds the rings of a spinning scanner in a file's points. Ring numbers are those of the field `ring`, otherwise
/// clusters of the elevations seen from the file's viewpoint (findRings()). Azimuths are those of the field `azimuth`,
/// in radians, degrees or hundredths of degrees, the first whose full turn (6.28, 360 or 36000) covers all values;
/// otherwise the directions seen from there.
/// @param name of the file, for messages
/// @return one entry per point, with the position of the sensor
/// @throws IoError if there is no field `ring` and elevations show no rings, or if azimuths have none of these units
ScanStructure ringsOf(const Geometry& geometry, const std::string& name);

}  // namespace tufted
