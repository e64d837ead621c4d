#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "operator.h"
#include "tufted/spectrum.h"

// The eigenpairs that a command works with: computed, or those that `tufted spectrum` wrote.

/// Which eigenpairs, as the options of a command state it.
struct Eigenpairs {
  int count = 0;  ///< how many; the default of the command, of which there may be fewer, until the user gives another
  std::string option = {};            ///< name of the option that sets it
  bool is_given = false;              ///< whether the user gave it
  bool has_zeros = false;             ///< whether the eigenvalues 0 are among them
  std::filesystem::path folder = {};  ///< given by --spectrum; empty: they are computed
};

/// Adds the option that sets the number of pairs.
CLI::Option* addCount(CLI::App& command, Eigenpairs& pairs, const std::string& option, int least,
                      const std::string& help);
/// Adds --spectrum, which excludes the options of solving.
void addSpectrumFolder(CLI::App& command, Eigenpairs& pairs);

/// Refuses, before anything is built, more pairs than there can be and a folder whose last result is no spectrum.
/// @throws InvalidInput naming the option; IoError naming the file that is missing
void checkPairs(const Eigenpairs& pairs, const Operator& source);

/// How many pairs to compute: those that the user asks for, or the default where there are as many.
int countOf(const Eigenpairs& pairs, const Operator& source, bool null_space);
/// So many first pairs, computed. @throws InvalidInput naming the option, if it is given, where there are fewer
tufted::Spectrum computedPairs(const Eigenpairs& pairs, int count, const Operator& source,
                               const tufted::SpectrumOptions& options);
/// The pairs of positive eigenvalues. Of a folder all that it has, if the user gave no number.
/// @throws InvalidInput naming the option where there are fewer; IoError as tufted::readSpectrum()
tufted::Spectrum positivePairs(const Eigenpairs& pairs, const Operator& source);
/// The first pairs, those of eigenvalue 0 among them, also where the folder has left these out.
/// @throws as positivePairs()
tufted::Spectrum firstPairs(const Eigenpairs& pairs, const Operator& source);
/// The pairs of positive eigenvalues in the folder.
tufted::Spectrum readPositivePairs(const Eigenpairs& pairs, const Operator& source);

/// How many eigenvalues are 0: one for each component that has an area.
int nullSpace(const tufted::Laplacian& laplacian);
/// Says how large the null space is.
void addNullSpace(int nulls, bool is_written, Results& results);
