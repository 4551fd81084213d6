#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/text.h"

namespace rowland::gpu {

/// A name and a value for `#define`.
using Define = std::pair<std::string, std::string>;

/// One shader stage's text with its includes pasted in. Line l of files[i] is numbered i · lines_per_file + l: the
/// number of the file is in the line's, because Mesa 22 loses the source string's within expressions.
struct ShaderText {
    std::string text;
    std::vector<std::string> files;
};
inline constexpr std::size_t lines_per_file = 100000;

/// The language of an assembled stage: dialect.glsl.
enum class Dialect {
    Desktop,  ///< as the file's `#version` says
    Es300,    ///< GLSL ES 3.00, that of WebGL 2
};

/// `#line` so that the line below it counts as line `line` of files[file].
std::string line_directive(std::size_t file, std::size_t line);

/// The shader files of engine/gpu: dialect.glsl and full_screen_triangle.vert.glsl. Every ShaderLibrary holds them.
std::span<const EmbeddedFile> shader_files();

/// Finds shader files by their path from the top of the source tree, among those built into the program or, for hot
/// reload, in a folder first.
class ShaderLibrary {
 public:
    ShaderLibrary();

    /// Adds files, whose text must outlive the library. A file of the same name is replaced.
    void add_embedded(std::span<const EmbeddedFile> files);
    /// Adds one file in the same way.
    void add(std::string name, std::string_view text) { embedded_[std::move(name)] = text; }
    /// From now on, files are read from `folder` (the top of a source tree) if they are there.
    void set_source_folder(std::optional<std::filesystem::path> folder) { source_folder_ = std::move(folder); }

    /// All files built into the program.
    std::vector<std::string> names() const;
    /// The text of a file. Throws Error (system) if there is none of that name.
    std::string read(const std::string& name) const;

    /// A stage's whole text. `#include "name"` is looked up beside the including file, then from the top; a file is
    /// pasted once however often it is included. `#include NAME` pastes the file that the define NAME gives in quotes,
    /// or nothing if there is none; for the compiler such a define has no value. Lines for C++ in headers of both
    /// languages, from `#ifdef __cplusplus` to the `#else` or `#endif`, become blank. The defines go below the file's
    /// own `#version`, which must be its first directive. Throws Error (system) that names the file and the line of a
    /// bad include.
    ShaderText assemble(const std::string& name, std::span<const Define> defines = {},
                        Dialect dialect = Dialect::Desktop) const;

 private:
    std::optional<std::string> find(const std::string& name) const;
    void paste(const std::string& name, std::span<const Define> defines, ShaderText& result) const;
    std::string resolve_include(const std::string& name, const std::string& includer, std::size_t line) const;

    std::map<std::string, std::string_view, std::less<>> embedded_;
    std::optional<std::filesystem::path> source_folder_;
};

}  // namespace rowland::gpu
