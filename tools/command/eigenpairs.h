#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "operator.h"
#include "tufted/spectrum.h"

// The eigenpairs that a command uses: computed, or read from what `tufted spectrum` wrote.

/// Which eigenpairs are used, by the options of a command.
struct Eigenpairs {
  int count = 0;                      ///< number of pairs; unless given, a default that may exceed what exists
  std::string option = {};            ///< name of the option that sets `count`
  bool is_given = false;              ///< whether the user gave `count`
  bool has_zeros = false;             ///< whether the eigenvalues 0 are included
  std::filesystem::path folder = {};  ///< folder given by --spectrum; empty: pairs are computed
};

/// Adds the option that sets the number of pairs.
CLI::Option* addCount(CLI::App& command, Eigenpairs& pairs, const std::string& option, int least,
                      const std::string& help);
/// Adds --spectrum, which excludes the options of solving.
void addSpectrumFolder(CLI::App& command, Eigenpairs& pairs);

/// Checks options before the build.
/// @throws InvalidInput naming the option for more pairs than there can be; IoError naming a file that a folder without
/// a spectrum lacks
void checkPairs(const Eigenpairs& pairs, const Operator& source);

/// How many pairs to compute: the number given, or the default, but at most as many as there are.
int countOf(const Eigenpairs& pairs, const Operator& source, bool null_space);
/// Computes the first `count` pairs. @throws InvalidInput if there are fewer, naming the option if it is given
tufted::Spectrum computedPairs(const Eigenpairs& pairs, int count, const Operator& source,
                               const tufted::SpectrumOptions& options);
/// The first pairs of positive eigenvalues; all pairs of a folder if no number is given.
/// @throws InvalidInput naming the option if there are fewer; IoError as tufted::readSpectrum()
tufted::Spectrum positivePairs(const Eigenpairs& pairs, const Operator& source);
/// The first pairs, including those of eigenvalue 0 even if the folder does not have these.
/// @throws as positivePairs()
tufted::Spectrum firstPairs(const Eigenpairs& pairs, const Operator& source);
/// Reads the pairs of positive eigenvalues from the folder.
tufted::Spectrum readPositivePairs(const Eigenpairs& pairs, const Operator& source);

/// Dimension of the null space: the number of components that have an area.
int nullSpace(const tufted::Laplacian& laplacian);
/// Notes the dimension of the null space in the results.
void addNullSpace(int nulls, bool is_written, Results& results);
