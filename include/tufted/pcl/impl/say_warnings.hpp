#pragma once

#include <pcl/console/print.h>

#include <string>

#include "tufted/denoise.h"
#include "tufted/report.h"

namespace tufted::detail {

/// Prints the warnings of a build or of denoise() on PCL's console.
/// @param report of a build or of denoise()
template <class AnyReport>
void sayWarnings(const std::string& class_name, const AnyReport& report) {
  if (report.points == 0) return;
  for (const std::string& sentence : warnings(report))
    PCL_WARN("[tufted::%s] %s\n", class_name.c_str(), sentence.c_str());
}

}  // namespace tufted::detail
