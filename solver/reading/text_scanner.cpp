#include "solver/reading/text_scanner.h"

#include <utility>

#include "solver/reading/number_text.h"

namespace lightwell {

namespace {

bool is_blank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
}

bool is_line_end(char letter) {
    return letter == '\n' || letter == '\r';
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file, int first_line)
    : text_(text), file_(std::move(file)), line_(first_line) {}

bool TextScanner::at_line_end(std::size_t position) const {
    return position >= text_.size() || is_line_end(text_[position]);
}

void TextScanner::skip_line_end() {
    if (position_ >= text_.size()) return;
    const bool carriage_return = text_[position_] == '\r';
    ++position_;
    if (carriage_return && position_ < text_.size() && text_[position_] == '\n') ++position_;
    line_start_ = position_;
    ++line_;
}

void TextScanner::skip_blanks() {
    while (position_ < text_.size()) {
        if (is_blank(text_[position_])) {
            ++position_;
        } else if (text_[position_] == '\\' && position_ + 1 < text_.size() &&
                   is_line_end(text_[position_ + 1])) {
            ++position_;
            skip_line_end();
        } else {
            return;
        }
    }
}

bool TextScanner::next_line() {
    if (started_) {
        while (next()) {
        }
        skip_line_end();
    }
    started_ = true;
    return position_ < text_.size();
}

std::optional<Token> TextScanner::next() {
    skip_blanks();
    if (at_line_end(position_)) return std::nullopt;
    if (text_[position_] == '#') {
        while (!at_line_end(position_))
            ++position_;
        return std::nullopt;
    }
    const std::size_t start = position_;
    const int start_column = column();
    while (!at_line_end(position_) && !is_blank(text_[position_])) {
        if (text_[position_] == '\\' && position_ > start && at_line_end(position_ + 1)) break;
        ++position_;
    }
    return Token{text_.substr(start, position_ - start), line_, start_column};
}

Token TextScanner::rest() {
    skip_blanks();
    const std::size_t start = position_;
    const int start_column = column();
    std::size_t end = position_;
    while (!at_line_end(position_)) {
        const bool after_blank = position_ == start || is_blank(text_[position_ - 1]);
        if (text_[position_] == '#' && after_blank &&
            (at_line_end(position_ + 1) || is_blank(text_[position_ + 1])))
            break;
        if (!is_blank(text_[position_])) end = position_ + 1;
        ++position_;
    }
    return {text_.substr(start, end - start), line_, start_column};
}

Token TextScanner::expect(const char* what) {
    if (const auto token = next()) return *token;
    throw InputError(here(), std::string(what) + " is missing");
}

double TextScanner::number(const Token& token) const {
    // The place is made only where it is needed: it copies the file's name.
    try {
        return number_from(token.text, Place{});
    } catch (const InputError& error) {
        throw InputError(place(token), error.what());
    }
}

std::int64_t TextScanner::whole_number(const Token& token) const {
    try {
        return whole_number_from(token.text, Place{});
    } catch (const InputError& error) {
        throw InputError(place(token), error.what());
    }
}

}  // namespace lightwell
