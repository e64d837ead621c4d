#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

/// Explains why arguments were refused: names an unknown word and the nearest known one, or else repeats CLI11's
/// `error`.
/// @param arguments without the name of the program
/// @return one line, which ends with the call for help, of the subcommand if one is named
std::string explainArguments(const CLI::App& app, const std::vector<std::string>& arguments, const std::string& error);

/// Whether CLI11 would misread the arguments: it ignores a first word that is no subcommand if --help follows, and
/// reads -out=DIR as -o ut=DIR.
bool isMisleading(const CLI::App& app, const std::vector<std::string>& arguments);
