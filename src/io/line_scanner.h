#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::io {

/// The lines of a text as tokens. Blank lines are passed over; `\n`, `\r\n` and a lone `\r` end
/// a line.
class LineScanner {
 public:
  struct Syntax {
    std::string_view separators = " \t\r\f\v";
    std::string_view delimiters = {};    ///< separators with a token before each and between any two
    char comment = '\0';                 ///< a token that begins with it ends the line
    bool comment_anywhere = false;       ///< `comment` ends the line within a token, too; `1.#INF` then is no number
    std::string_view line_comment = {};  ///< a line that begins with it holds no token
    bool continued = false;              ///< a line whose last token is a backslash goes on in the next
  };

  /// `path` and `text` are borrowed.
  LineScanner(const std::filesystem::path& path, std::string_view text, Syntax syntax);
  LineScanner(const std::filesystem::path& path, std::string_view text) : LineScanner(path, text, Syntax()) {}

  /// Goes on from byte `offset`, the beginning of the line after number `line`.
  void seek(std::size_t offset, std::int64_t line) {
    offset_ = newline_ = offset;
    line_ = line;
  }

  /// Moves to the next line that holds a token. False at the end of the text. @throws IoError naming the line
  bool next();

  const std::vector<std::string_view>& tokens() const { return tokens_; }
  std::int64_t line() const { return line_; }     ///< number of the current line, from 1
  std::size_t offset() const { return offset_; }  ///< where the following line begins
  /// Whether the text ends in this line, so that its last word may be cut off.
  bool isCutOff() const { return offset_ > text_.size(); }

  /// The number in a token of this line. @throws IoError naming the line
  double number(std::size_t token) const;
  std::int64_t integer(std::size_t token) const;
  /// The integer that is a part of this line. @throws IoError naming the line
  std::int64_t integerOf(std::string_view text) const;
  /// The integer in front of the first `end` in a token, or the whole token. @throws IoError naming the line
  std::int64_t integerBefore(std::size_t token, char end) const;

  /// Throws IoError naming the line.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void appendTokens();
  /// Refuses what lies before the next token or the end of the line if it holds an empty field, or another delimiter
  /// than lies between the first two tokens.
  void checkGap(std::string_view gap, bool at_end);

  const std::filesystem::path& path_;
  std::string_view text_;
  Syntax syntax_;
  std::size_t offset_ = 0;
  std::size_t newline_ = 0;  ///< position of the first newline behind `offset_`
  std::int64_t line_ = 0;
  char delimiter_ = '\0';
  std::vector<std::string_view> tokens_;
};

/// The tokens of the first line that holds any, to tell a format by. Throws nothing.
std::vector<std::string_view> firstTokens(std::string_view text, LineScanner::Syntax syntax);

}  // namespace tufted::io
