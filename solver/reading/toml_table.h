#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "radiance4d/failure.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A table of a TOML file that is read strictly: a wrong type is an error, never a default, and so
/// is a key nobody asked for (refuse_unknown_keys), which is most often a misspelt one. All errors
/// are InputErrors with file, line and column.
class TomlTable {
  public:
    /// Reads and parses a whole file. @throws InputError for syntax errors, too
    static TomlTable read(const std::string& path);

    /// Whether the key is there. Asking makes the key a known one.
    bool has(const std::string& key) const;
    /// Whether the key is there with a text as its value.
    bool is_text(const std::string& key) const;

    // The value of a key that must be there. Numbers are finite; whole ones may stand for others.
    std::string text(const std::string& key) const;
    double number(const std::string& key) const;
    std::int64_t whole_number(const std::string& key) const;
    bool flag(const std::string& key) const;
    /// Three numbers.
    Vec3 vector(const std::string& key) const;
    /// Three numbers, or one for grey.
    Rgb colour(const std::string& key) const;
    TomlTable table(const std::string& key) const;
    /// The tables of [[key]]; none if the key is absent.
    std::vector<TomlTable> tables(const std::string& key) const;

    /// All keys, in alphabetical order; they become known ones.
    std::vector<std::string> keys() const;

    /// @throws InputError at the first key that nobody asked for, naming those that are known
    void refuse_unknown_keys() const;

    /// Where the table starts, or the value of a key.
    Place place() const;
    Place place(const std::string& key) const;
    /// @throws InputError at the value of a key
    [[noreturn]] void fail(const std::string& key, const std::string& message) const;

  private:
    struct Node;
    explicit TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}
    std::shared_ptr<Node> node_;
};

}  // namespace lightwell
