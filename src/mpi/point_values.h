#pragma once

#include <petscvec.h>

#include <cstdint>
#include <vector>

// Values of vectors that other processes own.

namespace tufted {

/// The entries of this process.
std::vector<double> localOf(Vec vector);
void setLocal(Vec vector, const std::vector<double>& values);

/// Entries with any numbers. Collective.
std::vector<double> valuesAt(Vec vector, const std::vector<std::int64_t>& numbers);
/// Sets entries with any numbers, or adds to them. Collective.
void setAt(Vec vector, const std::vector<std::int64_t>& numbers, const std::vector<double>& values,
           InsertMode mode = INSERT_VALUES);

}  // namespace tufted
