#pragma once

#include <petscvec.h>

#include <cstdint>
#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// Rows of other processes that rows of this process use. They are numbered behind the own ones.
class Ghosts {
 public:
  /// Collective. @param rows any rows of L; those of this process are left out
  Ghosts(const DistributedLaplacian& laplacian, std::vector<std::int64_t> rows);

  int own() const { return own_; }
  int size() const { return own_ + static_cast<int>(others_.size()); }
  /// The number here of a row of L, which must be own or have been given.
  int numberOf(std::int64_t row) const;
  /// Replaces the values of other processes' rows by those that they have. Collective.
  /// @param values size() of them, the own ones first
  void update(std::vector<double>& values) const;

 private:
  PetscInt first_ = 0;
  int own_ = 0;
  std::vector<std::int64_t> others_;  ///< ascending
  PetscVector vector_;                ///< with room for the others
};

}  // namespace tufted
