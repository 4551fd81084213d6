#include "tests/gpu_cost/spirv.h"

#include <cstring>
#include <regex>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::gpu_cost {

namespace {

constexpr std::uint64_t kMostSpirvBytes = 1 << 26;

/// Groups: qualifiers, "out" or "in", name, "[" of an array.
const std::regex& interface_pattern() {
    static const std::regex pattern(R"(^((?:flat |noperspective )?(out|in) \w+ (\w+)(\[)?))", std::regex::multiline);
    return pattern;
}

std::map<std::string, int> locations_of(const std::string& vertex) {
    std::map<std::string, int> locations;
    for (const bool arrays : {false, true})
        for (std::sregex_iterator found(vertex.begin(), vertex.end(), interface_pattern()), end; found != end; ++found)
            if ((*found)[2] == "out" && (*found)[4].matched == arrays)
                locations.try_emplace((*found)[3], static_cast<int>(locations.size()));
    return locations;
}

/// With a location for each name that has one.
std::string located(const std::string& stage, const std::map<std::string, int>& locations) {
    std::string text;
    std::string::const_iterator copied = stage.begin();
    for (std::sregex_iterator found(stage.begin(), stage.end(), interface_pattern()), end; found != end; ++found) {
        const auto location = locations.find((*found)[3]);
        if (location == locations.end()) continue;
        text.append(copied, (*found)[0].first);
        text += "layout(location = " + std::to_string(location->second) + ") " + found->str();
        copied = (*found)[0].second;
    }
    return text.append(copied, stage.end());
}

std::string replace_all(std::string text, const std::string& searched, const std::string& replacement) {
    for (std::size_t at = text.find(searched); at != std::string::npos;
         at = text.find(searched, at + replacement.size()))
        text.replace(at, searched.size(), replacement);
    return text;
}

/// Marks all loops. Those over a number that was put in may run 0 times, which Mesa takes for unknown: a condition
/// before them removes them.
std::string unroll(const std::string& text) {
    static const std::regex counted(R"(\bfor \(int \w+ = ([^;]*); \w+ < ([^;&]*float\(\d[^;&]*);)");
    static const std::regex loop(R"(\bfor \()");
    const std::string guarded = std::regex_replace(text, counted, "if (($1) < ($2)) $&");
    const std::string marked = std::regex_replace(guarded, loop, "[[unroll]] for (");
    const std::size_t first_line = marked.find('\n') + 1;  // #version
    return marked.substr(0, first_line) + "#extension GL_EXT_control_flow_attributes : require\n" +
           marked.substr(first_line);
}

std::vector<std::uint32_t> read_words(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_file(path, kMostSpirvBytes);
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

std::string first_error(const std::string& output) {
    const std::size_t start = output.find("ERROR");
    return start == std::string::npos ? output : output.substr(start, output.find('\n', start) - start);
}

}  // namespace

ProgramText for_vulkan(const ProgramText& text) {
    const std::map<std::string, int> locations = locations_of(text.vertex);
    return {located(text.vertex, locations), located(text.fragment, locations)};
}

ProgramText with_loops_unrolled(const ProgramText& text, const std::map<std::string, int>& lengths) {
    ProgramText unrolled = text;
    for (std::string* stage : {&unrolled.vertex, &unrolled.fragment})
        for (const auto& [expression, length] : lengths) {
            const std::string number = std::to_string(length);
            *stage = replace_all(*stage, expression, expression.ends_with("()") ? number : "float(" + number + ")");
        }
    unrolled.fragment = replace_all(unrolled.fragment, "< parts;", "< 1;");
    return {unroll(unrolled.vertex), unroll(unrolled.fragment)};
}

Spirv compile_to_spirv(const ProgramText& text) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "program.vert", text.vertex);
    write_file_atomic(folder.path() / "program.frag", text.fragment);
    const test::Ended ended =
        test::run({"/usr/bin/env", "glslangValidator", "-V", "--target-env", "vulkan1.1", "-R", "-l", "--amb", "--aml",
                   "--shift-ssbo-binding", std::to_string(kFirstStorageBinding), "--shift-sampler-binding",
                   std::to_string(kFirstTextureBinding), "--shift-texture-binding",
                   std::to_string(kFirstTextureBinding), "program.vert", "program.frag"},
                  {.folder = folder.path()});
    if (ended.code == 127) fail_system("glslangValidator", "not installed", "install it (Debian: glslang-tools)");
    if (ended.code != 0) fail_system("glslangValidator", first_error(ended.out + ended.err));
    return {read_words(folder.path() / "vert.spv"), read_words(folder.path() / "frag.spv")};
}

}  // namespace rowland::gpu_cost
