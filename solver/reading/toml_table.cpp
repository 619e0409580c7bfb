#include "solver/reading/toml_table.h"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "solver/reading/input_file.h"

namespace lightwell {

namespace {

constexpr std::int64_t largest_toml = std::int64_t(16) << 20;

Place place_in(const std::string& file, const toml::source_region& region) {
    return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::string kind_of(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "a list";
        case toml::node_type::string:
            return "the text " + in_quotes(node.as_string()->get());
        case toml::node_type::integer:
            return "the number " + std::to_string(node.as_integer()->get());
        case toml::node_type::floating_point:
            return fmt::format("the number {}", node.as_floating_point()->get());
        case toml::node_type::boolean:
            return node.as_boolean()->get() ? "true" : "false";
        default:
            return "a date or time";
    }
}

[[noreturn]] void wrong_type(const std::string& file, const toml::node& node,
                             const std::string& key, const std::string& expected) {
    throw InputError(place_in(file, node.source()),
                     fmt::format("{} must be {}, not {}", key, expected, kind_of(node)));
}

double number_of(const std::string& file, const toml::node& node, const std::string& key,
                 const std::string& expected) {
    if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
    const auto* number = node.as_floating_point();
    if (!number || !std::isfinite(number->get())) wrong_type(file, node, key, expected);
    return number->get();
}

}  // namespace

struct TomlTable::Node {
    std::shared_ptr<const toml::table> file_content;  ///< keeps `table` alive
    const toml::table* table;
    std::string file;
    std::string path;   ///< "material.red"; "" for the file itself
    std::string title;  ///< "[camera]", for messages; "" for the file itself
    std::set<std::string> known;

    const toml::node* find(const std::string& key) {
        known.insert(key);
        return table->get(key);
    }
    const toml::node& required(const std::string& key, const Place& place) {
        if (const toml::node* node = find(key)) return *node;
        throw InputError(place, fmt::format("the key {} is missing{}", key, in_title()));
    }
    std::string in_title() const { return title.empty() ? "" : " in " + title; }
};

TomlTable TomlTable::read(const std::string& path) {
    const std::string text = read_text(path, largest_toml);
    try {
        auto content =
            std::make_shared<const toml::table>(toml::parse(std::string_view(text), path));
        const toml::table* table = content.get();
        return TomlTable(std::make_shared<Node>(Node{std::move(content), table, path, "", "", {}}));
    } catch (const toml::parse_error& error) {
        throw InputError(place_in(path, error.source()), std::string(error.description()));
    }
}

bool TomlTable::has(const std::string& key) const {
    return node_->find(key) != nullptr;
}

bool TomlTable::is_text(const std::string& key) const {
    const toml::node* node = node_->find(key);
    return node && node->is_string();
}

std::string TomlTable::text(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    const auto* text = node.as_string();
    if (!text) wrong_type(node_->file, node, key, "a text");
    return text->get();
}

double TomlTable::number(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    return number_of(node_->file, node, key, "a finite number");
}

std::int64_t TomlTable::whole_number(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    const auto* whole = node.as_integer();
    if (!whole) wrong_type(node_->file, node, key, "a whole number");
    return whole->get();
}

bool TomlTable::flag(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    const auto* flag = node.as_boolean();
    if (!flag) wrong_type(node_->file, node, key, "true or false");
    return flag->get();
}

Vec3 TomlTable::vector(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    const auto* list = node.as_array();
    if (!list) wrong_type(node_->file, node, key, "three numbers");
    if (list->size() != 3)
        fail(key, fmt::format("{} must be three numbers, not {}", key, list->size()));
    Vec3 value;
    for (std::size_t i = 0; i < 3; ++i)
        value[static_cast<Eigen::Index>(i)] =
            number_of(node_->file, (*list)[i], key, "three finite numbers");
    return value;
}

Rgb TomlTable::colour(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    if (node.is_array()) return vector(key).array();
    return Rgb::Constant(number_of(node_->file, node, key, "a number or three [r, g, b]"));
}

TomlTable TomlTable::table(const std::string& key) const {
    const toml::node& node = node_->required(key, place());
    const auto* table = node.as_table();
    const std::string path = node_->path.empty() ? key : node_->path + "." + key;
    if (!table) wrong_type(node_->file, node, key, "a table [" + path + "]");
    return TomlTable(std::make_shared<Node>(
        Node{node_->file_content, table, node_->file, path, "[" + path + "]", {}}));
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
    std::vector<TomlTable> tables;
    const toml::node* node = node_->find(key);
    if (!node) return tables;
    const std::string expected = "a list of tables [[" + key + "]]";
    const auto* list = node->as_array();
    if (!list) wrong_type(node_->file, *node, key, expected);
    for (const toml::node& entry : *list) {
        const auto* table = entry.as_table();
        if (!table) wrong_type(node_->file, entry, key, expected);
        tables.push_back(TomlTable(std::make_shared<Node>(
            Node{node_->file_content, table, node_->file, key, "[[" + key + "]]", {}})));
    }
    return tables;
}

std::vector<std::string> TomlTable::keys() const {
    std::set<std::string> names;
    for (const auto& [key, value] : *node_->table)
        names.insert(std::string(key.str()));
    node_->known.insert(names.begin(), names.end());
    return {names.begin(), names.end()};
}

void TomlTable::refuse_unknown_keys() const {
    const toml::key* first = nullptr;
    for (const auto& [key, value] : *node_->table)
        if (node_->known.count(std::string(key.str())) == 0 &&
            (!first || key.source().begin < first->source().begin))
            first = &key;
    if (!first) return;
    std::string known;
    for (const std::string& key : node_->known)
        known += (known.empty() ? "" : ", ") + key;
    throw InputError(place_in(node_->file, first->source()),
                     fmt::format("unknown key {}{}; known here: {}",
                                 in_quotes(std::string(first->str())), node_->in_title(), known));
}

Place TomlTable::place() const {
    return place_in(node_->file, node_->table->source());
}

Place TomlTable::place(const std::string& key) const {
    const toml::node* node = node_->table->get(key);
    return node ? place_in(node_->file, node->source()) : place();
}

void TomlTable::fail(const std::string& key, const std::string& message) const {
    throw InputError(place(key), message);
}

}  // namespace lightwell
