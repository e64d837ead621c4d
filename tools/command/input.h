#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>

#include "summary.h"
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

/// Reads the input.
/// @throws IoError and Cancelled as tufted::read(); InvalidInput for --weld with a cloud, whose equal points are always
/// merged
tufted::Geometry readInput(const Input& input, const tufted::Progress& progress);

/// Notes that equal corners of an STL were merged, so that indices of points are not places in the file.
void addMerged(const tufted::Geometry& geometry, Summary& summary);
