#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "summary.h"
#include "tufted/io/head.h"
#include "tufted/io/read.h"

/// The input of a command.
struct Input {
  std::filesystem::path file;  ///< `-`: standard input; may be a pipe, such as the shell's <(command)
  tufted::ReadAs as = tufted::ReadAs::automatic;
  bool weld = false;  ///< see MeshOptions::weld

  bool isStandardInput() const { return file == "-"; }
  /// Name of the input in messages.
  std::string name() const { return isStandardInput() ? "standard input" : file.string(); }
};

/// Adds FILE, which is required, and --as. Returns the option FILE.
CLI::Option* addInput(CLI::App& command, Input& input);

/// Adds --weld, for commands that take meshes.
void addWeld(CLI::App& command, Input& input);

/// Bytes per point that a build of L and M takes at least: 300 of an exact surface, by docs/speed.md.
constexpr double least_build_bytes = 300;

/// Message of an input whose L and M do not fit into memory.
/// @param bytes what they take
std::string memoryText(const Input& input, std::int64_t points, double bytes);

/// Reads the header of the input, if that is possible without reading all of it, see tufted::readHead().
std::optional<tufted::FileHead> readInputHead(const Input& input);

/// Refuses a cloud whose header counts more points than can be built in the available memory, before it is read.
/// @throws FileTooLarge; IoError as tufted::readHead()
void refuseTooMany(const Input& input);

/// Reads the input.
/// @throws IoError and Cancelled as tufted::read(); InvalidInput for --weld with a cloud, whose equal points are always
/// merged
tufted::Geometry readInput(const Input& input, const tufted::Progress& progress);

/// Notes that equal corners of an STL were merged, so that indices of points are not places in the file.
void addMerged(const tufted::Geometry& geometry, Summary& summary);
