#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

/// Says what is wrong with arguments that the application does not take. A word that it does not know is named, with
/// the known one that is nearest; otherwise `error` stands, what CLI11 says.
/// @param arguments without the name of the program
/// @returns one line that ends with where to find help, of the subcommand where there is one
std::string explainArguments(const CLI::App& app, const std::vector<std::string>& arguments, const std::string& error);

/// Whether the first word is none of the subcommands, nor an option. CLI11 would go on and might find --help.
bool beginsWithUnknownCommand(const CLI::App& app, const std::vector<std::string>& arguments);
