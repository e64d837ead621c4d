#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/scan_case.h"

namespace tufted::bench {

/// The figures of one metric, by seed.
struct Figures {
  std::vector<double> values;
  double seconds = 0;  ///< time of the measurements, without the builds

  double mean() const;
  double low() const;
  double high() const;
};

/// One metric of one case over all variants.
struct Row {
  std::string what, dataset;
  const Metric* metric = nullptr;
  bool is_full_size = true;
  std::vector<Figures> figures;  ///< by variant
  Figures yardstick;             ///< empty without a yardstick
};

enum class Verdict { unmarked, missed, held, stretched };

/// Whether a variant satisfies the mark of a row, even if the mark does not apply to it.
Verdict judge(const Row& row, std::size_t variant);
/// The mark in words, with the variant to which it applies; "" without a mark.
std::string markText(const Row& row);

void printHeader();
/// Prints a line per variant and one for the yardstick.
void printRow(const Row& row, const std::vector<Variant>& variants);
/// Prints for every variant the marks that apply to it, and for the first one all marks.
void printSummary(const std::vector<Row>& rows, const std::vector<Variant>& variants);
nlohmann::ordered_json asJson(const Row& row, const std::vector<Variant>& variants);

}  // namespace tufted::bench
