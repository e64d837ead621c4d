#include "bench/scan_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

namespace tufted::bench {
namespace {

using Rule = Mark::Rule;
using Reference = Mark::Reference;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string text(double value, Format kind) {
  if (std::isnan(value)) return "failed";
  switch (kind) {
    case Format::scientific:
      return format("%.2e", value);
    case Format::percent:
      return format("%.2f %%", 100 * value);
    case Format::signed_percent:
      return format("%+.2f %%", 100 * value);
    case Format::count:
      return format("%.4g", value);
    case Format::seconds:
      return format("%.2f s", value);
  }
  return "";
}

double meanDistance(const Figures& figures) {
  double sum = 0;
  for (const double value : figures.values) sum += std::abs(value);
  return sum / static_cast<double>(figures.values.size());
}

bool isMarked(const Row& row) {
  const Mark& mark = row.metric->mark;
  return mark.rule != Rule::none && (row.is_full_size || mark.at_any_size || mark.reference != Reference::none);
}

bool isFor(const Mark& mark, const Variant& variant) {
  return mark.variant == "all" || mark.variant == variant.name;
}

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::unmarked:
      return "";
    case Verdict::missed:
      return "no";
    case Verdict::held:
      return "yes";
    case Verdict::stretched:
      return "stretch";
  }
  return "";
}

void printLine(const Row& row, const std::string& variant, const Figures& figures, const std::string& mark,
               const char* verdict) {
  const Format kind = row.metric->format;
  const std::string range = figures.values.size() > 1 ? format("[%s, %s]", text(figures.low(), kind).c_str(),
                                                               text(figures.high(), kind).c_str())
                                                      : "";
  std::printf("%-13s %-33s %-22s %-9s %9s  %-22s %7.1f  %-36s %s\n", row.what.c_str(), row.dataset.c_str(),
              row.metric->name.c_str(), variant.c_str(), text(figures.mean(), kind).c_str(), range.c_str(),
              figures.seconds, mark.c_str(), verdict);
  std::fflush(stdout);
}

nlohmann::ordered_json asJson(const Figures& figures) {
  return {{"mean", figures.mean()},
          {"low", figures.low()},
          {"high", figures.high()},
          {"seeds", figures.values},
          {"seconds", figures.seconds}};
}

}  // namespace

double Figures::mean() const {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double Figures::low() const {
  return *std::min_element(values.begin(), values.end());
}

double Figures::high() const {
  return *std::max_element(values.begin(), values.end());
}

Verdict judge(const Row& row, std::size_t variant) {
  const Mark& mark = row.metric->mark;
  const Figures& figures = row.figures[variant];
  if (!isMarked(row) || figures.values.empty()) return Verdict::unmarked;
  double base = 0;
  if (mark.reference == Reference::core) base = mark.factor * row.figures.front().mean();
  if (mark.reference == Reference::yardstick) base = mark.factor * row.yardstick.mean();
  const auto holds = [&](double value) {
    switch (mark.rule) {
      case Rule::at_most:
        return figures.mean() <= base + value;
      case Rule::at_least:
        return figures.mean() >= base + value;
      case Rule::off_by_at_most:
        return meanDistance(figures) <= base + value;
      case Rule::none:
        break;
    }
    return false;
  };
  if (!holds(mark.value)) return Verdict::missed;  // also for NaN, a figure that could not be measured
  return holds(mark.stretch) ? Verdict::stretched : Verdict::held;
}

std::string markText(const Row& row) {
  if (!isMarked(row)) return "";
  const Metric& metric = *row.metric;
  const Mark& mark = metric.mark;
  const Format kind = metric.format == Format::signed_percent ? Format::percent : metric.format;
  std::string rule = mark.rule == Rule::at_most ? "<= " : mark.rule == Rule::at_least ? ">= " : "off by <= ";
  if (mark.reference == Reference::none) {
    rule += text(mark.value, kind);
  } else {
    if (mark.factor != 1) rule += format("%g ", mark.factor);
    rule += mark.reference == Reference::core ? "core" : metric.yardstick.name;
    if (mark.value != 0) rule += " + " + text(mark.value, kind);
  }
  if (!std::isnan(mark.stretch)) rule += " (stretch " + text(mark.stretch, kind) + ")";
  return mark.variant + ": " + rule;
}

void printHeader() {
  std::printf("%-13s %-33s %-22s %-9s %9s  %-22s %7s  %-36s %s\n", "what", "dataset", "metric", "build", "mean",
              "[low, high]", "seconds", "mark", "held");
}

void printRow(const Row& row, const std::vector<Variant>& variants) {
  for (std::size_t v = 0; v < variants.size(); ++v) {
    if (row.figures[v].values.empty()) continue;  // this variant was not built
    printLine(row, variants[v].name, row.figures[v], markText(row), word(judge(row, v)));
  }
  if (!row.yardstick.values.empty()) printLine(row, row.metric->yardstick.name, row.yardstick, "", "");
}

void printSummary(const std::vector<Row>& rows, const std::vector<Variant>& variants) {
  for (std::size_t v = 0; v < variants.size(); ++v) {
    int marks = 0, held = 0;
    for (const Row& row : rows) {
      const Verdict verdict = judge(row, v);
      if (verdict == Verdict::unmarked || (v > 0 && !isFor(row.metric->mark, variants[v]))) continue;
      ++marks;
      if (verdict != Verdict::missed) ++held;
    }
    std::printf("%s: %d of %d marks held\n", variants[v].name.c_str(), held, marks);
  }
}

nlohmann::ordered_json asJson(const Row& row, const std::vector<Variant>& variants) {
  nlohmann::ordered_json json{{"what", row.what}, {"dataset", row.dataset}, {"metric", row.metric->name}};
  if (isMarked(row)) json["mark"] = markText(row);
  if (!row.yardstick.values.empty()) json[row.metric->yardstick.name] = asJson(row.yardstick);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    if (row.figures[v].values.empty()) continue;
    nlohmann::ordered_json figures = asJson(row.figures[v]);
    const Verdict verdict = judge(row, v);
    if (verdict != Verdict::unmarked) figures["held"] = verdict != Verdict::missed;
    json["builds"][variants[v].name] = std::move(figures);
  }
  return json;
}

}  // namespace tufted::bench
