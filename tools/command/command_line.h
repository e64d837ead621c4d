#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

/// Says what is wrong with arguments that the application does not take. A word that it does not know is named, with
/// the known one that is nearest; otherwise `error` stands, what CLI11 says.
/// @param arguments without the name of the program
/// @returns one line that ends with where to find help, of the subcommand where there is one
std::string explainArguments(const CLI::App& app, const std::vector<std::string>& arguments, const std::string& error);

/// Whether CLI11 would take the arguments, but not as they are meant: it passes over a first word that is no subcommand
/// when --help follows, and takes -out=DIR for -o ut=DIR.
bool isMisleading(const CLI::App& app, const std::vector<std::string>& arguments);
