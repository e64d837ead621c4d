#pragma once

namespace tufted {

/// While one of these lives, OpenBLAS works on one thread: its sums, and so the last bits, depend on their number, and
/// work is split over right sides instead. No effect on other BLAS libraries. So do the OpenMP loops of the thread that
/// made it, of which CHOLMOD has some: OpenMP's threads do not survive a fork, after which a child would wait for them
/// for ever.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int nesting_;  ///< how deep OpenMP's parallel regions might lie in one another
};

}  // namespace tufted
