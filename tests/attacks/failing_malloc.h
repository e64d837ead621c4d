#pragma once

#include <cstddef>
#include <cstdint>

namespace tufted::attacks {

/// From now on the request number `nth` (from 1) of any thread for memory from malloc() fails, which is also where
/// operator new and Eigen take memory; with `from_then_on` all later ones too. 0: none fails.
/// @param least only requests of at least so many bytes count
void failRequest(std::int64_t nth, bool from_then_on = false, std::size_t least = 0);

/// Whether a request has failed since the last failRequest().
bool hasFailed();

/// Blocks that were taken and not given back, by all threads and libraries.
std::int64_t liveBlocks();

}  // namespace tufted::attacks
