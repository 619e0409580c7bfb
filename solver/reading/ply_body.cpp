#include "solver/reading/ply_body.h"

#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/text_scanner.h"

namespace lightwell {

namespace {

class TextBody : public PlyBody {
  public:
    TextBody(std::string_view text, const PlyHeader& header, const std::string& file)
        : scanner_(text.substr(header.body), file, header.body_line) {}

    void begin_row(const PlyElement& element, std::int64_t row) override {
        while (scanner_.next_line()) {
            pending_ = scanner_.next();
            if (pending_) {
                last_ = *pending_;
                return;
            }
        }
        throw InputError(scanner_.here(),
                         fmt::format("the file ends before row {} of {} {}", row + 1, element.count,
                                     in_quotes(element.name)));
    }

    void end_row() override {
        if (const auto extra = next())
            throw InputError(scanner_.place(*extra),
                             in_quotes(std::string(extra->text)) + " is more than the row needs");
    }

    double number(PlyType) override { return scanner_.number(expect()); }
    std::int64_t whole_number(PlyType) override { return scanner_.whole_number(expect()); }

    void skip(PlyType, std::int64_t count) override {
        for (std::int64_t i = 0; i < count; ++i)
            expect();
    }

    [[noreturn]] void fail(const std::string& message) const override {
        throw InputError(scanner_.place(last_), message);
    }
    int line() const override { return last_.line; }
    bool at_end() override {
        while (scanner_.next_line())
            if (scanner_.next()) return false;
        return true;
    }

  private:
    /// The first word of a row is read to find the row.
    std::optional<Token> next() {
        if (pending_) return std::exchange(pending_, std::nullopt);
        return scanner_.next();
    }

    const Token& expect() {
        const auto token = next();
        if (!token) throw InputError(scanner_.here(), "a number of the row is missing");
        last_ = *token;
        return last_;
    }

    TextScanner scanner_;
    std::optional<Token> pending_;
    Token last_;
};

class BinaryBody : public PlyBody {
  public:
    BinaryBody(std::string_view bytes, const PlyHeader& header, std::string file)
        : bytes_(bytes),
          position_(header.body),
          big_endian_(header.format == PlyFormat::binary_big_endian),
          file_(std::move(file)) {}

    void begin_row(const PlyElement& element, std::int64_t row) override {
        element_ = &element;
        row_ = row;
    }
    void end_row() override {}

    double number(PlyType type) override {
        if (type == PlyType::float32) return static_cast<double>(take<float>());
        if (type == PlyType::float64) return take<double>();
        return static_cast<double>(whole_number(type));
    }

    std::int64_t whole_number(PlyType type) override {
        LIGHTWELL_CHECK(is_whole(type));
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            default:
                return take<std::uint32_t>();
        }
    }

    void skip(PlyType type, std::int64_t count) override {
        if (static_cast<std::size_t>(count) > (bytes_.size() - position_) / size_of(type))
            fail("the file ends too early");
        position_ += static_cast<std::size_t>(count) * size_of(type);
    }

    [[noreturn]] void fail(const std::string& message) const override {
        throw InputError(Place{file_},
                         fmt::format("byte {}, row {} of {} {}: {}", position_, row_ + 1,
                                     element_->count, in_quotes(element_->name), message));
    }
    int line() const override { return 0; }
    bool at_end() override { return position_ == bytes_.size(); }

  private:
    template <typename Number>
    Number take() {
        std::uint64_t bits = 0;
        if (bytes_.size() - position_ < sizeof(Number)) fail("the file ends too early");
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            const std::size_t place = big_endian_ ? i : sizeof(Number) - 1 - i;
            bits = bits << 8 | static_cast<unsigned char>(bytes_[position_ + place]);
        }
        position_ += sizeof(Number);
        // The low bytes of `bits`, through an integer of the number's own size.
        Number number;
        if constexpr (sizeof(Number) == 8) {
            std::memcpy(&number, &bits, 8);
        } else {
            const auto low = static_cast<std::uint32_t>(bits);
            if constexpr (sizeof(Number) == 4)
                std::memcpy(&number, &low, 4);
            else
                number = static_cast<Number>(low);
        }
        return number;
    }

    std::string_view bytes_;
    std::size_t position_;
    bool big_endian_;
    std::string file_;
    const PlyElement* element_ = nullptr;
    std::int64_t row_ = 0;
};

}  // namespace

std::int64_t PlyBody::list_length(const PlyProperty& list) {
    const std::int64_t length = whole_number(list.length_type);
    if (length < 0 || length > std::numeric_limits<std::uint32_t>::max())
        fail(fmt::format("a list of {} entries", length));
    return length;
}

std::unique_ptr<PlyBody> ply_body(std::string_view bytes, const PlyHeader& header,
                                  const std::string& file) {
    if (header.format == PlyFormat::ascii) return std::make_unique<TextBody>(bytes, header, file);
    return std::make_unique<BinaryBody>(bytes, header, file);
}

}  // namespace lightwell
