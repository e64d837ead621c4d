#include "version.h"

#include <CLI/Version.hpp>
#include <Eigen/Core>

#include "tufted/version.h"

#ifdef TUFTED_WITH_GPL
namespace {
constexpr const char* licence =
    R"(The source is under the BSD 3-clause licence. This binary also contains GPL parts of CGAL (Delaunay triangulations)
and is linked with CHOLMOD, whose supernodal part is GPL: as a whole it is under the GPL, version 3 or later. You may use
it for anything; who passes it on must pass on its whole source as well. Built with -DTUFTED_WITH_GPL=OFF it has none.)";
constexpr const char* factors = "CHOLMOD (supernodal), and multigrid where factors would not fit";
constexpr const char* triangulations = "stars of the project, --delaunay cgal";
}  // namespace
#else
namespace {
constexpr const char* licence =
    R"(The source is under the BSD 3-clause licence. This binary was built without GPL parts; of CGAL and Eigen it contains
parts under the LGPL and the MPL.)";
constexpr const char* factors = "Eigen (SimplicialLDLT), and multigrid where factors would not fit";
constexpr const char* triangulations = "stars of the project; not --delaunay cgal";
}  // namespace
#endif

std::string versionText() {
  const std::string eigen = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                            std::to_string(EIGEN_MINOR_VERSION);
  return std::string("tufted ") + TUFTED_VERSION + "\n\n" + licence + "\n\n" + "Factors:        " + factors + "\n" +
         "Triangulations: " + triangulations + "\n" +
         "Reads:          PCD, PLY, LAS, text in columns, NPY, OBJ, OFF, STL, VTK\n" +
         "Writes:         NPY and NPZ, Matrix Market, MATLAB, PLY, PCD, JSON\n" + "Built with:     " + __VERSION__ +
         ", Eigen " + eigen + ", CLI11 " + CLI11_VERSION;
}
