#include "io/line_scanner.h"

#include <algorithm>

#include "io/errors.h"
#include "io/number.h"

namespace tufted::io {

LineScanner::LineScanner(const std::filesystem::path& path, std::string_view text, Syntax syntax)
    : path_(path), text_(text), syntax_(syntax) {
  if (text_.starts_with("\xEF\xBB\xBF")) offset_ = 3;  // byte order mark of UTF-8
}

bool LineScanner::next() {
  tokens_.clear();
  while (tokens_.empty() && offset_ < text_.size()) {
    appendTokens();
    while (syntax_.continued && !tokens_.empty() && tokens_.back() == "\\") {
      tokens_.pop_back();
      appendTokens();
    }
  }
  return !tokens_.empty();
}

void LineScanner::appendTokens() {
  if (offset_ >= text_.size()) return;
  // Kept, so that a text whose lines end in a lone \r is not searched again from each of its lines.
  if (newline_ <= offset_) newline_ = std::min(text_.find('\n', offset_), text_.size());
  std::size_t end = newline_;
  const std::size_t carriage = text_.substr(offset_, end - offset_).find('\r');
  if (carriage != std::string_view::npos && offset_ + carriage + 1 != end) end = offset_ + carriage;
  std::string_view line = text_.substr(offset_, end - offset_);
  offset_ = end + 1;
  ++line_;
  if (syntax_.comment_anywhere) line = line.substr(0, line.find(syntax_.comment));
  std::size_t stop = 0;
  while (stop < line.size()) {
    const std::size_t begin = std::min(line.find_first_not_of(syntax_.separators, stop), line.size());
    const bool at_end = begin == line.size() || (syntax_.comment != '\0' && line[begin] == syntax_.comment);
    checkGap(line.substr(stop, begin - stop), at_end);
    if (at_end) return;
    stop = std::min(line.find_first_of(syntax_.separators, begin), line.size());
    tokens_.push_back(line.substr(begin, stop - begin));
    if (tokens_.size() == 1 && !syntax_.line_comment.empty() && tokens_[0].starts_with(syntax_.line_comment)) {
      tokens_.clear();
      return;
    }
  }
}

void LineScanner::checkGap(std::string_view gap, bool at_end) {
  if (syntax_.delimiters.empty()) return;
  char delimiter = '\0';  // stays 0 if the gap has only blanks
  for (const char c : gap) {
    if (syntax_.delimiters.find(c) == std::string_view::npos) continue;
    if (delimiter != '\0' || tokens_.empty()) refuse("value " + std::to_string(tokens_.size() + 1) + " is empty");
    delimiter = c;
  }
  if (tokens_.empty() || at_end) return;
  if (tokens_.size() == 1) delimiter_ = delimiter;
  if (delimiter != delimiter_) refuse("values are separated in two ways; decimals need a point");
}

double LineScanner::number(std::size_t token) const {
  double value = 0;
  if (!parseNumber(tokens_[token], value)) refuse(quote(tokens_[token]) + " is not a number");
  return value;
}

std::int64_t LineScanner::integer(std::size_t token) const {
  return integerBefore(token, '\0');
}

std::int64_t LineScanner::integerBefore(std::size_t token, char end) const {
  return integerOf(tokens_[token].substr(0, tokens_[token].find(end)));
}

std::int64_t LineScanner::integerOf(std::string_view text) const {
  std::int64_t value = 0;
  if (!parseNumber(text, value)) refuse(quote(text) + " is not an integer");
  return value;
}

void LineScanner::refuse(const std::string& reason) const {
  refuseLine(path_, line_, reason);
}

std::vector<std::string_view> firstTokens(std::string_view text, LineScanner::Syntax syntax) {
  const std::filesystem::path nowhere;
  syntax.delimiters = {};  // an empty value is not an error here
  LineScanner scanner(nowhere, text, syntax);
  scanner.next();
  return scanner.tokens();
}

}  // namespace tufted::io
