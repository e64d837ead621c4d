#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "paths.h"
#include "tufted/io/write.h"

/// Adds --out, also -o, which is required.
void addOut(CLI::App& command, std::filesystem::path& out);

/// Adds --format, which takes a list everywhere: names of `formats`, separated by commas; `none` stands alone.
void addFormats(CLI::App& command, std::vector<tufted::Format>& target,
                const std::map<std::string, tufted::Format>& formats, const std::string& help);

/// Adds --format for copies of the points with the results: ply and pcd.
void addCopies(CLI::App& command, std::vector<tufted::Format>& target);

/// Refuses what no results can be written to, before anything is computed.
/// @param inputs of the command
/// @param files that will be written into `out`
/// @throws InvalidInput where `out` or one of them is an input; IoError as tufted::checkWritable
void checkOutput(const std::vector<NamedInput>& inputs, const std::filesystem::path& out,
                 const std::vector<std::string>& files);
