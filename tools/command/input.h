#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "summary.h"
#include "tufted/io/head.h"
#include "tufted/io/read.h"
#include "tufted/io/select.h"
#include "tufted/io/tiles.h"

/// The options that choose points of a cloud before anything is computed, and what they chose.
struct ChosenPoints {
  tufted::Selection selection;
  std::string crop;  ///< value of --crop; empty: not given
  std::filesystem::path polygon;
  std::int64_t of = 0;    ///< points of the file; 0: all are kept
  std::int64_t kept = 0;  ///< points that were kept
  std::vector<int> rows;  ///< the row in the file of each point; empty: the points are those of the file, in order

  /// Whether any of the options was given.
  bool isAsked() const { return !selection.isEmpty() || !crop.empty() || !polygon.empty(); }
  /// The row in the file of a point. @param point its row in the results
  int numberOf(int point) const { return rows.empty() ? point : rows[static_cast<std::size_t>(point)]; }
  /// The row in the results of a point, -1 if it was not chosen. @param number its row in the file
  int rowOf(int number) const;
  /// A message in which points have their rows in the results, with those in the file instead.
  std::string inFile(const std::string& message) const;
  /// The conditions and counts, for report.json.
  nlohmann::ordered_json json() const;
};

/// The input of a command.
struct Input {
  std::filesystem::path file;  ///< `-`: standard input; may be a pipe, such as the shell's <(command)
  tufted::ReadAs as = tufted::ReadAs::automatic;
  bool weld = false;  ///< see MeshOptions::weld
  ChosenPoints chosen;

  bool isStandardInput() const { return file == "-"; }
  /// Name of the input in messages.
  std::string name() const { return isStandardInput() ? "standard input" : file.string(); }
};

/// Adds --where, --crop, --polygon and --thin.
void addSelection(CLI::App& command, ChosenPoints& chosen);

/// Adds FILE, which is required, --as, and the options that choose points. Returns the option FILE.
CLI::Option* addInput(CLI::App& command, Input& input);

/// Adds --weld, for commands that take meshes.
void addWeld(CLI::App& command, Input& input);

/// Bytes per point that a build of L and M takes at least: 300 of an exact surface, by docs/speed.md.
constexpr double least_build_bytes = 300;

/// Message of an input that takes more memory than there is.
/// @param bytes what they take
std::string memoryText(const Input& input, std::int64_t points, double bytes);

/// Reads the header of the input, if that is possible without reading all of it, see tufted::readHead().
std::optional<tufted::FileHead> readInputHead(const Input& input);

/// Refuses a cloud whose header counts more points than fit into the available memory, before it is read, unless points
/// are chosen.
/// @param bytes that the command takes per point at least
/// @throws FileTooLarge; IoError as tufted::readHead()
void refuseTooMany(const Input& input, double bytes = least_build_bytes);

/// The points of the input that were chosen, for tiles: in passes if the file allows that, see tufted::sourceOf(). Sets
/// the counts of input.chosen. @throws as tufted::sourceOf()
tufted::FileSource openInput(Input& input, const tufted::Progress& progress);

/// Reads the input, and drops the points that were not chosen.
/// @throws IoError and Cancelled as tufted::read(); InvalidInput for --weld with a cloud, whose equal points are always
/// merged, for choosing points of a mesh, and as select()
tufted::Geometry readInput(Input& input, const tufted::Progress& progress);

/// Notes that equal corners of an STL were merged, so that indices of points are not places in the file, and how many
/// points were chosen.
void addMerged(const tufted::Geometry& geometry, const Input& input, Summary& summary);
