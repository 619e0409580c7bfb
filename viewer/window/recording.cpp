#include "viewer/window/recording.h"

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/text_scanner.h"

namespace lightwell {

namespace {

constexpr std::int64_t most_frames = 1'000'000;
constexpr std::int64_t longest_side = 16384;  // [pixels]
constexpr const char* buttons[] = {"left", "right", "middle"};

/// One line, read word by word.
class Statement {
  public:
    explicit Statement(TextScanner& scanner) : scanner_(scanner) {}

    Token word(const char* what) { return scanner_.expect(what); }
    double number(const char* what) { return scanner_.number(word(what)); }
    std::int64_t whole_number(const char* what, std::int64_t low, std::int64_t high) {
        const Token token = word(what);
        const std::int64_t number = scanner_.whole_number(token);
        if (number < low || number > high)
            refuse(token, fmt::format("not within {} and {}", low, high));
        return number;
    }
    double seconds() {
        const Token token = word("the seconds of a frame");
        const double seconds = scanner_.number(token);
        if (!(seconds >= 0)) refuse(token, "negative");
        return seconds;
    }
    bool down() {
        const Token token = word("down or up");
        if (token.text != "down" && token.text != "up") refuse(token, "neither down nor up");
        return token.text == "down";
    }
    std::string path() {
        const Token token = scanner_.rest();
        if (token.text.empty()) throw InputError(scanner_.place(token), "a path is missing");
        return std::string(token.text);
    }
    void end() {
        if (const auto more = scanner_.next()) refuse(*more, "more than the statement takes");
    }

    [[noreturn]] void refuse(const Token& token, const std::string& flaw) const {
        throw InputError(scanner_.place(token), in_quotes(std::string(token.text)) + " is " + flaw);
    }

  private:
    TextScanner& scanner_;
};

Key key_from(Statement& statement) {
    const Token token = statement.word("the name of a key");
    const Key key = key_named(token.text);
    if (key == Key::unknown) statement.refuse(token, "no key");
    return key;
}

MouseButton button_from(Statement& statement) {
    const Token token = statement.word("the name of a button");
    for (std::size_t k = 0; k < std::size(buttons); ++k)
        if (token.text == buttons[k]) return static_cast<MouseButton>(k);
    statement.refuse(token, "no button: left, right or middle");
}

Input input_from(const Token& verb, Statement& statement) {
    constexpr std::int64_t last_character = 0x10ffff;
    if (verb.text == "key") {
        const Key key = key_from(statement);
        return KeyInput{key, statement.down()};
    }
    if (verb.text == "text")
        return TextInput{static_cast<char32_t>(
            statement.whole_number("the number of a character", 1, last_character))};
    if (verb.text == "button") {
        const MouseButton button = button_from(statement);
        return ButtonInput{button, statement.down()};
    }
    if (verb.text == "cursor") {
        const double x = statement.number("x");
        return CursorInput{{x, statement.number("y")}};
    }
    if (verb.text == "wheel") return WheelInput{statement.number("the notches of a wheel")};
    if (verb.text == "size") {
        const auto width = static_cast<int>(statement.whole_number("a width", 1, longest_side));
        return SizeInput{width,
                         static_cast<int>(statement.whole_number("a height", 1, longest_side))};
    }
    if (verb.text == "drop") return DropInput{statement.path()};
    if (verb.text == "picture") return PictureInput{statement.path(), false};
    if (verb.text == "window") return PictureInput{statement.path(), true};
    if (verb.text == "memory") return MemoryInput{statement.path()};
    if (verb.text == "focus") {
        const Token what = statement.word("lost");
        if (what.text != "lost") statement.refuse(what, "not 'lost'");
        return FocusLost{};
    }
    statement.refuse(verb, "no statement");
}

const char* direction(bool down) {
    return down ? "down" : "up";
}

/// Writes an input as a statement.
struct Writer {
    std::string operator()(const KeyInput& i) const {
        return fmt::format("key {} {}", name_of(i.key), direction(i.down));
    }
    std::string operator()(const TextInput& i) const {
        return fmt::format("text {}", static_cast<std::uint32_t>(i.character));
    }
    std::string operator()(const ButtonInput& i) const {
        return fmt::format("button {} {}", buttons[static_cast<std::size_t>(i.button)],
                           direction(i.down));
    }
    std::string operator()(const CursorInput& i) const {
        return fmt::format("cursor {} {}", i.position[0], i.position[1]);
    }
    std::string operator()(const WheelInput& i) const { return fmt::format("wheel {}", i.notches); }
    std::string operator()(const SizeInput& i) const {
        return fmt::format("size {} {}", i.width, i.height);
    }
    std::string operator()(const DropInput& i) const { return "drop " + i.path; }
    std::string operator()(const FocusLost&) const { return "focus lost"; }
    std::string operator()(const PictureInput& i) const {
        return (i.whole_window ? "window " : "picture ") + i.path;
    }
    std::string operator()(const MemoryInput& i) const { return "memory " + i.path; }
};

}  // namespace

std::vector<InputFrame> input_from_text(const std::string& text, const std::string& source) {
    std::vector<InputFrame> frames;
    InputFrame next;
    TextScanner scanner(text, source);
    while (scanner.next_line()) {
        const auto verb = scanner.next();
        if (!verb) continue;
        Statement statement(scanner);
        if (verb->text != "frame" && verb->text != "frames") {
            next.inputs.push_back(input_from(*verb, statement));
            statement.end();
            continue;
        }
        const std::int64_t count =
            verb->text == "frame" ? 1
                                  : statement.whole_number("a number of frames", 1, most_frames);
        if (count > most_frames - static_cast<std::int64_t>(frames.size()))
            statement.refuse(*verb, fmt::format("beyond {} frames", most_frames));
        next.seconds = statement.seconds();
        statement.end();
        const double seconds = next.seconds;
        frames.push_back(std::move(next));
        frames.resize(frames.size() + static_cast<std::size_t>(count) - 1, {seconds, {}});
        next = {};
    }
    if (!next.inputs.empty()) frames.push_back(std::move(next));
    return frames;
}

std::string text_of(const InputFrame& frame) {
    std::string text;
    for (const Input& input : frame.inputs)
        // A key that nothing listens to has no name.
        if (const auto* key = std::get_if<KeyInput>(&input); !key || key->key != Key::unknown)
            text += std::visit(Writer(), input) + "\n";
    return text + fmt::format("frame {}\n", frame.seconds);
}

}  // namespace lightwell
