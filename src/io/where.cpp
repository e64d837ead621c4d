#include "io/where.h"

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

#include "io/columns.h"
#include "io/number.h"
#include "tufted/errors.h"

namespace tufted::io {
namespace {

/// The numbers that comparisons may name, each with its value at a point.
struct NamedValues {
  std::vector<std::string> names;
  std::vector<std::function<double(std::size_t point)>> values;

  explicit NamedValues(const Geometry& geometry) {
    for (const Field& field : geometry.fields) {
      if (isPackedColor(field)) {
        const char* const channels[] = {"blue", "green", "red"};  // in the order of the bytes
        for (int k = 0; k < 3; ++k)
          add(channels[k], [&field, k](std::size_t i) { return std::to_integer<int>(field.bytes[4 * i + k]); });
        continue;
      }
      for (int c = 0; c < field.count; ++c)
        add(field.count == 1 ? field.name : field.name + "_" + std::to_string(c),
            [&field, c](std::size_t i) { return valueOf(field, i * field.count + c); });
    }
    for (int c = 0; c < 3; ++c)
      add(std::string(1, "xyz"[c]), [&geometry, c](std::size_t i) { return geometry.points(i, c); });
    for (int c = 0; c < 3 && geometry.normals.rows() > 0; ++c)
      add(std::string("n") + "xyz"[c], [&geometry, c](std::size_t i) { return geometry.normals(i, c); });
  }

  template <class Value>
  void add(std::string name, Value value) {
    names.push_back(std::move(name));
    values.emplace_back(std::move(value));
  }
};

/// What a value may be to a range. All are false if one of the numbers is NaN.
struct Relation {
  std::string_view text;  ///< of two that begin alike the longer one stands first
  bool (*holds)(double value, double low, double high);
};
constexpr Relation relations[] = {
    {"==", [](double value, double low, double high) { return value >= low && value <= high; }},
    {"=", [](double value, double low, double high) { return value >= low && value <= high; }},
    {"!=", [](double value, double low, double high) { return value < low || value > high; }},
    {"<=", [](double value, double low, double) { return value <= low; }},
    {"<", [](double value, double low, double) { return value < low; }},
    {">=", [](double value, double low, double) { return value >= low; }},
    {">", [](double value, double low, double) { return value > low; }}};

/// The right side of a comparison: the values of a field, or a range, which for a number has one value.
struct Operand {
  std::function<double(std::size_t point)> low, high;
  bool is_range = false;
};

/// Parses a comparison from left to right.
class Comparison {
 public:
  Comparison(const Geometry& geometry, const std::string& text)
      : named_(geometry), text_(text), left_(fieldNamed(word())), relation_(takeRelation()) {
    const bool takes_lists = relation_.text[0] == '=' || relation_.text[0] == '!';
    do {
      right_.push_back(operand());
      if (right_.back().is_range && !takes_lists) fail("a range follows only = and !=");
    } while (takes_lists && take(","));
    if (!rest().empty()) fail("expected the end");
  }

  /// Whether a point equals one of a list or differs from all of it, or has another relation to the right side.
  bool holdsAt(std::size_t point) const {
    const auto held = [&, value = left_(point)](const Operand& right) {
      return relation_.holds(value, right.low(point), right.high(point));
    };
    return relation_.text == "!=" ? std::all_of(right_.begin(), right_.end(), held)
                                  : std::any_of(right_.begin(), right_.end(), held);
  }

 private:
  Operand operand() {
    const auto constant = [](double number) { return [number](std::size_t) { return number; }; };
    const std::string text = word();
    const std::size_t dots = text.find("..");
    double low = 0, high = 0;
    if (dots == std::string::npos) {
      if (parseNumber(text, low)) return {constant(low), constant(low)};
      const auto values = fieldNamed(text);
      return {values, values};
    }
    if (!parseNumber(text.substr(0, dots), low) || !parseNumber(text.substr(dots + 2), high) || !(low <= high))
      fail("'" + text + "' is not LOW..HIGH with LOW <= HIGH");
    return {constant(low), constant(high), true};
  }

  const std::function<double(std::size_t)>& fieldNamed(const std::string& name) const {
    const std::ptrdiff_t at = findField(named_.names, name);
    if (at >= 0) return named_.values[static_cast<std::size_t>(at)];
    std::string all;
    for (const std::string& known : named_.names) all += (all.empty() ? "" : ", ") + known;
    fail("'" + name + "' is no field, must be one of " + all);
  }

  Relation takeRelation() {
    for (const Relation& relation : relations)
      if (take(relation.text)) return relation;
    fail("expected =, !=, <, <=, > or >= after the field");
  }

  /// Takes the characters up to a blank, a comma or a relation.
  std::string word() {
    const std::string_view all = rest();
    const std::string found(all.substr(0, all.find_first_of(" \t=!<>,")));
    if (found.empty())
      fail("a field or a number is missing before " + (all.empty() ? "the end" : "'" + std::string(all) + "'"));
    at_ += found.size();
    return found;
  }

  bool take(std::string_view sought) {
    if (!rest().starts_with(sought)) return false;
    at_ += sought.size();
    return true;
  }

  /// What is left of the text, without leading blanks.
  std::string_view rest() {
    at_ = std::min(text_.find_first_not_of(" \t", at_), text_.size());
    return std::string_view(text_).substr(at_);
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw InvalidInput("select: where = '" + text_ + "': " + why);
  }

  NamedValues named_;
  const std::string& text_;
  std::size_t at_ = 0;
  std::function<double(std::size_t)> left_;
  Relation relation_;
  std::vector<Operand> right_;
};

}  // namespace

std::function<bool(std::size_t point)> where(const Geometry& geometry, const std::string& comparison) {
  return [parsed = Comparison(geometry, comparison)](std::size_t point) { return parsed.holdsAt(point); };
}

}  // namespace tufted::io
