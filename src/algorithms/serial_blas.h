#pragma once

namespace tufted {

/// While one of these lives, OpenBLAS works on one thread: its sums, and so the last bits, depend on their number, and
/// work is split over right sides instead. No effect on other BLAS libraries.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;
};

}  // namespace tufted
