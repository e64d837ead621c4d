#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

// Files and folders that a command reads and writes, and which of them are the same.

/// A file or folder that a command reads.
struct NamedInput {
  std::string option;  ///< option that names it, such as --handles; FILE or WHAT for arguments without an option
  std::filesystem::path path;
};

/// All files and folders that a command reads, after parsing: arguments without an option, and values of options of the
/// types TEXT, NPY, SOURCE and DIR except --out.
std::vector<NamedInput> inputsOf(const CLI::App& command);

/// Whether two paths name one file, which need not exist.
bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other);

/// Whether a path is `folder` or lies in it. Neither need exist.
bool isWithin(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Follows links to the file that a path names, which need not exist.
std::filesystem::path behindLinks(std::filesystem::path file);

/// Checks that an output is none of the inputs, also through links or another path.
/// @param option option of the output, with its value
/// @throws InvalidInput
void refuseOverwriting(const std::string& option, const std::filesystem::path& output,
                       const std::vector<NamedInput>& inputs);
