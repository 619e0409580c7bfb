#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "solver/reading/ply_header.h"

namespace lightwell {

/// The numbers of a PLY file, one after the other, whatever their encoding.
class PlyBody {
  public:
    virtual ~PlyBody() = default;

    /// Must be called before the first number of each row, and end_row after its last.
    virtual void begin_row(const PlyElement& element, std::int64_t row) = 0;
    virtual void end_row() = 0;
    /// The next number. @throws InputError if it is missing or malformed; it may be infinite in a
    /// binary file
    virtual double number(PlyType type) = 0;
    /// The next number, of a whole type.
    virtual std::int64_t whole_number(PlyType type) = 0;
    /// Passes over `count` numbers. @throws InputError if the file does not have as many
    virtual void skip(PlyType type, std::int64_t count) = 0;
    /// @throws InputError at the last number read, or with the row where places are not known
    [[noreturn]] virtual void fail(const std::string& message) const = 0;
    /// Line of the row, 0 in a binary file.
    virtual int line() const = 0;
    /// Whether anything but blanks is left.
    virtual bool at_end() = 0;

    /// The length of a list, which is never negative.
    std::int64_t list_length(const PlyProperty& list);
};

/// The body of a file whose header has been read.
std::unique_ptr<PlyBody> ply_body(std::string_view bytes, const PlyHeader& header,
                                  const std::string& file);

}  // namespace lightwell
