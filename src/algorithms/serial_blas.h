#pragma once

namespace tufted {

/// While an instance exists, OpenBLAS uses one thread, because the last bits of its sums depend on the number of
/// threads; work is split over right sides instead. Other BLAS libraries are not affected. OpenMP loops of the same
/// thread, as in CHOLMOD, are serial, too: OpenMP's threads do not survive a fork, and a child process would wait for
/// them forever.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int nesting_;  ///< OpenMP's limit on nested parallel regions before
};

}  // namespace tufted
