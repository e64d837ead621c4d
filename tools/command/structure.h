#pragma once

#include <map>
#include <optional>
#include <string>

#include "tufted/io/read.h"
#include "tufted/scan_structure.h"

/// How the neighbours of a cloud are found, as --structure states it.
enum class Structure { automatic, none, image, rings };

/// The values of --structure.
inline const std::map<std::string, Structure> structures = {{"automatic", Structure::automatic},
                                                            {"none", Structure::none},
                                                            {"image", Structure::image},
                                                            {"rings", Structure::rings}};

/// What `automatic` stands for: `image` for a cloud that a pinhole camera saw, else `none`.
Structure structureFor(const tufted::Geometry& geometry);

/// What to say of an image that was asked for where no pinhole camera at the file's viewpoint has its rays, along which
/// jumps and noise are looked for; else empty, as for `automatic`, which takes no such image.
std::string doubtOf(const tufted::Geometry& geometry, Structure structure);

/// The value of --structure.
std::string nameOf(Structure structure);

/// The structure of a file's scan, which is no longer `automatic`: its width and height; or its fields `ring` and
/// `azimuth`, and for either one that it lacks the elevations or azimuths seen from its viewpoint.
/// @param name of the input, for messages
/// @throws IoError where the file has no such structure, or azimuths of an unknown unit
std::optional<tufted::ScanStructure> structureOf(const tufted::Geometry& geometry, Structure structure,
                                                 const std::string& name);
