#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>

#include "summary.h"
#include "tufted/io/read.h"

/// The input of a command, as its options state it.
struct Input {
  std::filesystem::path file;  ///< `-` is standard input; may be a pipe, as the shell makes them for <(command)
  tufted::ReadAs as = tufted::ReadAs::automatic;
  bool weld = false;  ///< see MeshOptions::weld

  bool isStandardInput() const { return file == "-"; }
  /// Name of the input in messages.
  std::string name() const { return isStandardInput() ? "standard input" : file.string(); }
};

/// Adds FILE, which is required, and --as; gives FILE.
CLI::Option* addInput(CLI::App& command, Input& input);

/// Adds --weld, for commands that take meshes.
void addWeld(CLI::App& command, Input& input);

/// @throws IoError and Cancelled as tufted::read does; InvalidInput for --weld on a cloud, whose equal points are
/// merged anyway
tufted::Geometry readInput(const Input& input, const tufted::Progress& progress);

/// Tells that equal corners of a file without numbered vertices are one point, so indices are not places in the file.
void addMerged(const tufted::Geometry& geometry, Summary& summary);
