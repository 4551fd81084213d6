#include "engine/gpu/shader_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"

namespace rowland::gpu {

namespace {

constexpr std::uint64_t max_shader_bytes = 1 << 20;

[[noreturn]] void fail(const std::string& file, std::size_t line, std::string found, std::string expected,
                       std::string remedy = "") {
    throw Error({.file = file,
                 .location = line == 0 ? "" : fmt::format("line {}", line),
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = std::move(remedy),
                 .fault = Fault::System});
}

/// Matches `#include "name"` and `#include DEFINE`.
const std::regex& include_pattern() {
    static const std::regex pattern(R"re([ \t]*#[ \t]*include[ \t]*(?:"([^"]*)"|(\w+)))re");
    return pattern;
}

/// The file that a define names, or nothing.
std::string named_file(std::span<const Define> defines, const std::string& define) {
    for (const auto& [name, value] : defines)
        if (name == define && value.starts_with('"')) return value.substr(1, value.size() - 2);
    return "";
}

bool is_version(const std::string& line) {
    static const std::regex pattern(R"([ \t]*#[ \t]*version)");
    return std::regex_search(line, pattern, std::regex_constants::match_continuous);
}

/// Finds the lines that are C++'s in headers that both languages read: from `#ifdef __cplusplus` to its #else or
/// #endif, these directives included.
class CppLines {
 public:
    bool take(const std::string& line) {
        if (group_ == Group::None) {
            if (line.starts_with("#ifdef __cplusplus")) group_ = Group::Cpp;
            return group_ == Group::Cpp;
        }
        const bool was_cpp = group_ == Group::Cpp;
        if (line.starts_with("#if")) {
            ++nested_;
        } else if (line.starts_with("#endif") && nested_ > 0) {
            --nested_;
        } else if (line.starts_with("#else") && nested_ == 0) {
            group_ = Group::Glsl;
            return true;
        } else if (line.starts_with("#endif")) {
            group_ = Group::None;
            return true;
        }
        return was_cpp;
    }

 private:
    enum class Group { None, Cpp, Glsl } group_ = Group::None;
    int nested_ = 0;  ///< conditionals within the group
};

std::string defines_text(std::span<const Define> defines) {
    std::string text;
    for (const auto& [name, value] : defines)
        text += fmt::format("#define {} {}\n", name, value.starts_with('"') ? "" : value);
    return text;
}

}  // namespace

std::string line_directive(std::size_t file, std::size_t line) {
    return fmt::format("#line {}\n", file * lines_per_file + line);
}

ShaderLibrary::ShaderLibrary() {
    add_embedded(shader_files());
}

void ShaderLibrary::add_embedded(std::span<const EmbeddedFile> files) {
    for (const EmbeddedFile& file : files) embedded_[std::string(file.name)] = file.text;
}

std::optional<std::string> ShaderLibrary::find(const std::string& name) const {
    if (source_folder_ && std::filesystem::is_regular_file(*source_folder_ / name)) {
        return read_text_file(*source_folder_ / name, max_shader_bytes);
    }
    const auto found = embedded_.find(name);
    if (found == embedded_.end()) return std::nullopt;
    return std::string(found->second);
}

std::vector<std::string> ShaderLibrary::names() const {
    std::vector<std::string> result;
    for (const auto& [name, text] : embedded_) result.push_back(name);
    return result;
}

std::string ShaderLibrary::read(const std::string& name) const {
    if (std::optional<std::string> text = find(name)) return *std::move(text);
    const std::optional<std::string> nearest = nearest_word(name, names());
    fail(name, 0, "no such shader file", "a file built into the program or in the shader source folder",
         nearest ? fmt::format("did you mean {}?", *nearest) : "");
}

std::string ShaderLibrary::resolve_include(const std::string& name, const std::string& includer,
                                           std::size_t line) const {
    const std::string sibling =
        (std::filesystem::path(includer).parent_path() / name).lexically_normal().generic_string();
    for (const std::string& candidate : {sibling, name}) {
        if (find(candidate)) return candidate;
    }
    fail(includer, line, fmt::format("#include \"{}\"", name),
         fmt::format("a file {} or {} built into the program or in the shader source folder", sibling, name));
}

void ShaderLibrary::paste(const std::string& name, std::span<const Define> defines, ShaderText& result) const {
    const std::size_t index = result.files.size();
    const bool is_root = index == 0;
    result.files.push_back(name);
    if (!is_root) result.text += line_directive(index, 1);

    bool versioned = false;
    CppLines cpp;
    std::size_t line_number = 0;
    std::istringstream text(read(name));
    for (std::string line; std::getline(text, line);) {
        ++line_number;
        if (line.ends_with('\r')) line.pop_back();
        if (cpp.take(line)) {
            result.text += '\n';
            continue;
        }
        if (is_version(line)) {
            if (!is_root) fail(name, line_number, line, "no #version in an included file");
            versioned = true;
            result.text += line + "\n" + defines_text(defines) + line_directive(index, line_number + 1);
            continue;
        }
        std::smatch include;
        if (!std::regex_search(line, include, include_pattern(), std::regex_constants::match_continuous)) {
            result.text += line + "\n";
            continue;
        }
        if (is_root && !versioned) fail(name, line_number, line, "#version as the first directive");
        const std::string file = include[1].matched ? include[1].str() : named_file(defines, include[2].str());
        if (file.empty() && !include[1].matched) {
            result.text += '\n';
            continue;
        }
        const std::string included = resolve_include(file, name, line_number);
        const bool is_new = std::find(result.files.begin(), result.files.end(), included) == result.files.end();
        if (is_new) paste(included, defines, result);
        result.text += line_directive(index, line_number + 1);
    }
    if (is_root && !versioned) fail(name, 1, "no #version", "#version 450 core as the first directive");
}

ShaderText ShaderLibrary::assemble(const std::string& name, std::span<const Define> defines, Dialect dialect) const {
    ShaderText result;
    paste(name, defines, result);
    if (dialect == Dialect::Es300) {
        const std::size_t version = result.text.find("#version");
        result.text.replace(version, result.text.find('\n', version) - version, "#version 300 es");
    }
    return result;
}

}  // namespace rowland::gpu
