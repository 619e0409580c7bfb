#pragma once

#include <string>
#include <vector>

namespace lightwell::fuzz {

/// A parser of users' files.
struct Parser {
    const char* name;  ///< also that of the folder of its corpus
    const char* file;  ///< the name under which it wants its file
    void (*read)(const std::string& path);
};

const std::vector<Parser>& parsers();
/// @return nullptr if there is none of that name
const Parser* parser_named(const std::string& name);

/// Puts the bytes into a file of `folder` and reads it. An InputError is as good as success.
void read_bytes_as(const Parser& parser, const std::string& folder, const std::string& bytes);

}  // namespace lightwell::fuzz
