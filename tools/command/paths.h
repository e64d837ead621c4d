#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

// Files and folders that a command reads and writes, and which of them are the same.

/// A file or folder that a command reads.
struct NamedInput {
  std::string option;  ///< that names it, such as --handles; FILE or WHAT where it stands without one
  std::filesystem::path path;
};

/// All that a command reads, by its options once they are parsed: those without a dash, and of the types TEXT, NPY and
/// DIR all but --out.
std::vector<NamedInput> inputsOf(const CLI::App& command);

/// Whether two paths name one file, which need not exist.
bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other);

/// Whether a path is a folder or lies within it. None of both need exist.
bool isWithin(const std::filesystem::path& path, const std::filesystem::path& folder);

/// The file that a path names, behind all links; it need not exist.
std::filesystem::path behindLinks(std::filesystem::path file);

/// Refuses an output that is one of the inputs, through links and by other ways to it too.
/// @param option of the output, with its value
/// @throws InvalidInput
void refuseOverwriting(const std::string& option, const std::filesystem::path& output,
                       const std::vector<NamedInput>& inputs);
