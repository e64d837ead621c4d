#pragma once

#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "stars/stars.h"
#include "tufted/report.h"

namespace tufted {

/// How a star was found, see *The certificate* in section 6 of docs/algorithm.md.
enum class Certainty : std::uint8_t {
  certain,    ///< closed, and all its circles lie in the ball that was searched: no other point can change it
  widened,    ///< certain since its search was widened
  uncertain,  ///< closed, but a circle leaves the ball
  open
};

/// Searches are widened in this many rounds: widened stars may show that other searches were too narrow. A third round
/// widens a tenth as many stars as the second.
constexpr int widening_rounds = 2;

/// A star to be found among more neighbours.
struct Widening {
  int p = 0;
  double radius = 0;  ///< how far neighbours are to be searched
};

/// The points whose stars are not certain, but are named by a certain star that they do not name. Their searches were
/// too narrow: at a step of density the nearest neighbours of a point on the dense side are all on that side.
/// @param by which stars to ask
/// @returns one entry per point, in the order of points, with a radius that covers the circles of the triangles which
/// name it
Buffer<Widening> neededWidenings(const BuiltStars& built, const Buffer<Certainty>& certainty, Certainty by);

/// Replaces stars by those found from wider searches.
/// @param widened a star for each entry of `wanted`; an empty one replaces none
void replaceStars(std::span<const Widening> wanted, const BuiltStars& widened, BuiltStars& built,
                  Buffer<Certainty>& certainty, Report& report);

}  // namespace tufted
