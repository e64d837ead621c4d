// Writes the sample Laplacian into the directory given, for load_in_scipy.py.
#include "sample_laplacian.h"
#include "tufted/io/write.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  tufted::writeLaplacian(argv[1], sampleLaplacian(), sampleGeometry());
}
