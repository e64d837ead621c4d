#pragma once

#include <map>
#include <optional>
#include <string>

#include "tufted/io/read.h"
#include "tufted/scan_structure.h"

/// How the neighbours of a cloud are found: the values of --structure.
enum class Structure { automatic, none, image, rings };

/// The names of these values.
inline const std::map<std::string, Structure> structures = {{"automatic", Structure::automatic},
                                                            {"none", Structure::none},
                                                            {"image", Structure::image},
                                                            {"rings", Structure::rings}};

/// What `automatic` means for a file: `image` if it is a depth image (isDepthImage()), otherwise `none`.
Structure structureFor(const tufted::Geometry& geometry);

/// A warning if --structure image is given, but the cloud was seen by no pinhole camera at the file's viewpoint, along
/// whose rays jumps and noise are looked for; otherwise an empty string.
std::string doubtOf(const tufted::Geometry& geometry, Structure structure);

/// The name of a value.
std::string nameOf(Structure structure);

/// The structure of a file's scan: imageStructure() or ringsOf() of the file.
/// @param structure not `automatic`
/// @param name name of the input, for messages
/// @throws IoError if the file has no such structure, or azimuths of an unknown unit
std::optional<tufted::ScanStructure> structureOf(const tufted::Geometry& geometry, Structure structure,
                                                 const std::string& name);
