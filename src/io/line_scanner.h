#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::io {

/// Splits the lines of a text into tokens. Blank lines are skipped; `\n`, `\r\n` and a lone `\r` end a line.
class LineScanner {
 public:
  struct Syntax {
    std::string_view separators = " \t\r\f\v";
    std::string_view delimiters = {};    ///< separators, such as commas, between which a token must not be empty
    char comment = '\0';                 ///< a token that begins with it starts a comment
    bool comment_anywhere = false;       ///< `comment` starts one within a token too; `1.#INF` then is no number
    std::string_view line_comment = {};  ///< a line that begins with it is a comment
    bool continued = false;              ///< whether a backslash as last token continues the line in the next one
  };

  /// @param path,text borrowed
  LineScanner(const std::filesystem::path& path, std::string_view text, Syntax syntax);
  LineScanner(const std::filesystem::path& path, std::string_view text) : LineScanner(path, text, Syntax()) {}

  /// Continues at byte `offset`, where the line after number `line` begins.
  void seek(std::size_t offset, std::int64_t line) {
    offset_ = newline_ = offset;
    line_ = line;
  }

  /// Moves to the next line that has a token. Returns false at the end of the text. @throws IoError naming the line
  bool next();

  const std::vector<std::string_view>& tokens() const { return tokens_; }
  std::int64_t line() const { return line_; }     ///< number of the current line, from 1
  std::size_t offset() const { return offset_; }  ///< byte at which the next line begins
  /// Whether the text ends within this line, so that its last token may be cut off.
  bool isCutOff() const { return offset_ > text_.size(); }

  /// Parses token number `token` of this line. @throws IoError naming the line
  double number(std::size_t token) const;
  std::int64_t integer(std::size_t token) const;
  /// Parses a part of this line as an integer. @throws IoError naming the line
  std::int64_t integerOf(std::string_view text) const;
  /// Parses as an integer what precedes the first `end` in a token, or the whole token. @throws IoError naming the line
  std::int64_t integerBefore(std::size_t token, char end) const;

  /// Throws IoError naming the line.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void appendTokens();
  /// Refuses a gap before a token or the end of the line with an empty value, or another delimiter than the line's
  /// first.
  void checkGap(std::string_view gap, bool at_end);

  const std::filesystem::path& path_;
  std::string_view text_;
  Syntax syntax_;
  std::size_t offset_ = 0;
  std::size_t newline_ = 0;  ///< position of the first newline after `offset_`
  std::int64_t line_ = 0;
  char delimiter_ = '\0';
  std::vector<std::string_view> tokens_;
};

/// The tokens of the first line that has any, for recognising formats; empty if none has. Does not throw.
std::vector<std::string_view> firstTokens(std::string_view text, LineScanner::Syntax syntax);

}  // namespace tufted::io
