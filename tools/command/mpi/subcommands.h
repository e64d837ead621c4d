#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tufted/mpi/solves.h"
#include "tufted/mpi/write.h"

/// What a subcommand of tufted-mpi has computed.
struct MpiResults {
  tufted::DistributedResult files;
  std::vector<tufted::PetscVector> kept;  ///< the vectors of `files`
  std::optional<tufted::DistributedSolve> solve;
  std::vector<std::string> warnings;  ///< in process 0

  /// Adds NAME.npy, an array with a column for each vector.
  /// @param absent value of points that take no part
  void add(const std::string& name, std::vector<tufted::PetscVector> columns, double absent);
};

/// A subcommand of tufted-mpi: its options, what it reads, and what it computes. All functions but check() run in every
/// process.
class MpiSubcommand {
 public:
  /// @param files names of the results in DIR, without report.json
  MpiSubcommand(const char* name, const char* description, std::vector<std::string> files)
      : name(name), description(description), files(std::move(files)) {}
  virtual ~MpiSubcommand() = default;

  virtual void addOptions(CLI::App&) {}
  /// Whether the Laplacian must have its faces.
  virtual bool needsFaces() const { return false; }
  /// Reads small files and refuses what can be seen before the build, in process 0 alone: one message is enough.
  /// @param points number of points of FILE
  virtual void check(std::int64_t points) { (void)points; }
  virtual void compute(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource& source,
                       MpiResults& results) = 0;

  const char* const name;
  const char* const description;
  const std::vector<std::string> files;
};

/// All subcommands of tufted-mpi.
std::vector<std::unique_ptr<MpiSubcommand>> mpiSubcommands();
