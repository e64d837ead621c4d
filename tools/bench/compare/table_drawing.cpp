// Tables as drawings: a row of points per line of the table, a panel per column.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "bench/compare/table.h"

namespace tufted::bench {
namespace {

constexpr double row_height = 20, panel_width = 132, gap = 12, letter = 6.6, dot = 3.5;

std::string escaped(const std::string& words) {
  std::string text;
  for (const char c : words) text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return text;
}

/// The numbers of a cell, which may have several.
std::vector<double> numbersIn(const Cell& cell) {
  std::vector<double> found;
  const auto add = [&](const nlohmann::ordered_json& value) {
    if (value.is_number()) found.push_back(value.get<double>());
  };
  if (cell.value.is_array())
    for (const auto& value : cell.value) add(value);
  else
    add(cell.value);
  return found;
}

/// Where numbers of a column lie: on a logarithmic scale if they are of different orders and none is below 0, where 0
/// lies at the left end.
class Scale {
 public:
  explicit Scale(const std::vector<double>& all) {
    for (const double x : all) {
      if (!std::isfinite(x)) continue;
      low_ = std::min(low_, x), high_ = std::max(high_, x);
      if (x > 0) least_ = std::min(least_, x);
    }
    is_logarithmic_ = low_ >= 0 && high_ > 10 * least_;
  }
  double operator()(double x) const {
    const double share =
        is_logarithmic_ ? 0.1 + 0.9 * std::log(x / least_) / std::log(high_ / least_) : (x - low_) / (high_ - low_);
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0;
  }

 private:
  double low_ = 0, high_ = 0, least_ = std::numeric_limits<double>::infinity();
  bool is_logarithmic_ = false;
};

/// Splits words into lines that fit a panel.
std::vector<std::string> wrapped(const std::string& words) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string word = words.substr(begin, end - begin);
    if (!lines.back().empty() && letter * static_cast<double>(lines.back().size() + word.size()) > panel_width - gap)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

}  // namespace

void drawTable(const Table& table, const std::string& title, const std::filesystem::path& path) {
  const auto& columns = table.columns();
  const auto& rows = table.rows();
  // Columns of words in front name the rows.
  std::size_t names = 0;
  while (names < columns.size() && std::all_of(rows.begin(), rows.end(), [&](const std::vector<Cell>& row) {
           return row[names].value.is_string();
         }))
    ++names;
  std::vector<std::string> labels;
  std::size_t longest = 0, header = 1;
  for (const std::vector<Cell>& row : rows) {
    std::string label;
    for (std::size_t c = 0; c < names; ++c) label += (c > 0 ? ", " : "") + row[c].text;
    longest = std::max(longest, label.size());
    labels.push_back(label);
  }
  for (std::size_t c = names; c < columns.size(); ++c) header = std::max(header, wrapped(columns[c]).size());
  const double left = gap + letter * static_cast<double>(longest), top = row_height * static_cast<double>(header + 1);
  const double width = left + gap + (panel_width + gap) * static_cast<double>(columns.size() - names);
  const double height = top + row_height * static_cast<double>(rows.size()) + gap;
  std::ofstream file(path);
  file << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
       << "\" font-family=\"sans-serif\" font-size=\"12\">\n<title>" << escaped(title)
       << "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  const auto text = [&](double x, double y, const char* anchor, const char* color, const std::string& words) {
    file << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\" fill=\"" << color << "\">"
         << escaped(words) << "</text>\n";
  };
  const auto middleOf = [&](std::size_t row) { return top + row_height * (static_cast<double>(row) + 0.5); };
  const auto colorOf = [&](std::size_t row) {
    return labels[row].find("tufted") != std::string::npos ? "#b03a2e" : "#44546a";
  };
  for (std::size_t r = 0; r < rows.size(); ++r) text(left, middleOf(r) + 4, "end", colorOf(r), labels[r]);
  for (std::size_t c = names; c < columns.size(); ++c) {
    const double x = left + gap + (panel_width + gap) * static_cast<double>(c - names);
    const std::vector<std::string> lines = wrapped(columns[c]);
    for (std::size_t l = 0; l < lines.size(); ++l)
      text(x, row_height * static_cast<double>(l + 1), "start", "black", lines[l]);
    std::vector<double> all;
    for (const std::vector<Cell>& row : rows)
      for (const double number : numbersIn(row[c])) all.push_back(number);
    const Scale scale(all);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::vector<double> numbers = numbersIn(rows[r][c]);
      if (numbers.empty()) {
        text(x, middleOf(r) + 4, "start", "#888", rows[r][c].text);
        continue;
      }
      file << "<path d=\"M" << x << " " << middleOf(r) << "h" << panel_width << "\" stroke=\"#ddd\"/>\n";
      double last = 0;
      for (const double number : numbers) {
        last = x + panel_width * scale(number);
        file << "<circle cx=\"" << last << "\" cy=\"" << middleOf(r) << "\" r=\"" << dot << "\" fill=\"" << colorOf(r)
             << "\"/>\n";
      }
      if (numbers.size() > 1) continue;
      const bool is_right = last > x + panel_width / 2;
      text(last + (is_right ? -2 : 2) * dot, middleOf(r) + 4, is_right ? "end" : "start", "black", rows[r][c].text);
    }
  }
  file << "</svg>\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace tufted::bench
