#include "io/conventions.h"

#include "io/number.h"
#include "tufted/dummy_values.h"

namespace tufted::io {
namespace {

std::string inactive(const Laplacian& laplacian, const WriteOptions& options) {
  const std::string who = "points of status other than 0 keep their index; ";
  if (!options.dummy) return who + "their row and column of L and their mass are zero";
  return who + "dummy values: " + (options.sign == Sign::psd ? "1" : "-1") + " on the diagonal of L, mass " +
         shortestText(dummyMass(laplacian.M)) + " (a thousandth of the smallest positive mass, 1 if there is none)";
}

}  // namespace

std::vector<Convention> conventions(const Laplacian& laplacian, const WriteOptions& options) {
  const bool psd = options.sign == Sign::psd;
  return {
      {"L", psd ? "weak (integrated) Laplacian, symmetric positive semidefinite, off-diagonals <= 0, rows sum to 0"
                : "weak (integrated) Laplacian, symmetric negative semidefinite, off-diagonals >= 0, rows sum to 0"},
      {"sign", psd ? "L is minus the Laplacian, integrated; libigl and PMP use the opposite sign"
                   : "L is the Laplacian, integrated, with the sign of libigl and PMP"},
      {"M", "lumped areas in length^2, N values; their sum approximates the surface area", true},
      {"scale/cloud", "L: 1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners)"},
      {"scale/mesh", "L: 1/2 (front and back of the cover)"},
      {"poisson", psd ? "L u = M f" : "-L u = M f"},
      {"eigenproblem", psd ? "L x = lambda M x" : "-L x = lambda M x"},
      {"status", "0 active, 1 not finite, 2 coincident, 3 isolated", true},
      {"inactive", inactive(laplacian, options), true},
      {"representative", "the point that stands for a coincident one, else the point itself; counted from 0", true},
      {"boundary", "0 the surface goes on, 1 rim, 2 jump: another surface lies beyond, 3 lost: triangles are missing",
       true},
  };
}

std::string conventionLines(const std::vector<Convention>& conventions, const std::string& prefix,
                            bool per_point_only) {
  std::string lines;
  for (const Convention& convention : conventions)
    if (convention.per_point || !per_point_only)
      lines.append(prefix).append(convention.name).append(": ").append(convention.text).append("\n");
  return lines;
}

}  // namespace tufted::io
