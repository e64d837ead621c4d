#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "look.h"
#include "paths.h"
#include "tufted/io/write.h"

/// Adds --out, also -o, which is required.
void addOut(CLI::App& command, std::filesystem::path& out);

/// Adds --format, a list of names of `formats` separated by commas, or `none`.
void addFormats(CLI::App& command, std::vector<tufted::Format>& target,
                const std::map<std::string, tufted::Format>& formats, const std::string& help);

/// Adds --format for the copies of the points: ply, pcd and las.
void addCopies(CLI::App& command, std::vector<tufted::Format>& target);

/// Checks before the build, if one of the formats is LAS, that it has room for so many values per point and can hold
/// the first point.
/// @param name of the input, for messages
/// @param fields results of each point
/// @throws IoError for points that are not finite, InvalidInput as tufted::checkLas()
void requireLas(const tufted::Geometry& geometry, const std::vector<tufted::Format>& formats, const std::string& name,
                const std::vector<ShownField>& fields);

/// Checks before the build that `files` can be written into `out`.
/// @param inputs files and folders that the command reads
/// @throws InvalidInput if `out` or one of the files is an input; IoError as tufted::checkWritable()
void checkOutput(const std::vector<NamedInput>& inputs, const std::filesystem::path& out,
                 const std::vector<std::string>& files);
