#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "input.h"

/// Adds --out, also -o, which is required.
void addOut(CLI::App& command, std::filesystem::path& out);

/// Refuses what no results can be written to, before anything is computed.
/// @param files that will be written into `out`
/// @throws InvalidInput where one of them is the input; IoError as tufted::checkWritable
void checkOutput(const Input& input, const std::filesystem::path& out, const std::vector<std::string>& files);
