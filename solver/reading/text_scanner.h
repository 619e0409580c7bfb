#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "radiance4d/failure.h"

namespace lightwell {

/// A word of a text file and where it starts (line and byte column, from 1).
struct Token {
    std::string_view text;
    int line = 0;
    int column = 0;
};

/// Reads text line by line, word by word, as OBJ, MTL and ASCII PLY files are written.
///
/// Lines end in LF, CRLF or CR. Words are parted by blanks. A word that starts with '#' starts a
/// comment. A backslash at the end of a line joins it with the next one, but not in a comment,
/// where it is more likely the end of a Windows path.
class TextScanner {
  public:
    /// @param text must outlive the scanner and its tokens
    /// @param file for messages
    TextScanner(std::string_view text, std::string file, int first_line = 1);

    /// Goes to the next (joined) line, the first at the first call; false at the end of the text.
    bool next_line();
    /// The next word of the line, or nothing at its end.
    std::optional<Token> next();
    /// What is left of the line but for blanks at its ends: a name, which may hold blanks. '#'
    /// followed by a blank starts a comment; "Material #25" is a name.
    Token rest();

    /// The next word of the line. @throws InputError saying that `what` is missing
    Token expect(const char* what);
    double number(const Token& token) const;
    std::int64_t whole_number(const Token& token) const;

    Place place(const Token& token) const { return {file_, token.line, token.column}; }
    /// Where the scanner stands.
    Place here() const { return {file_, line_, column()}; }
    int line() const { return line_; }
    const std::string& file() const { return file_; }

  private:
    bool at_line_end(std::size_t position) const;
    void skip_line_end();
    void skip_blanks();
    int column() const { return static_cast<int>(position_ - line_start_) + 1; }

    std::string_view text_;
    std::string file_;
    std::size_t position_ = 0;
    std::size_t line_start_ = 0;
    int line_;
    bool started_ = false;
};

}  // namespace lightwell
