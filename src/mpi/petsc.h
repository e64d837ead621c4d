#pragma once

#include <petscsys.h>

#include <string>

#include "tufted/errors.h"

namespace tufted {

/// Throws SolverFailure for an error of PETSc.
inline void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw SolverFailure(std::string("PETSc: ") + (text != nullptr ? text : "error " + std::to_string(code)));
}

}  // namespace tufted
