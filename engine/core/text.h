#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rowland {

/// `text` as valid UTF-8: invalid bytes, which file names may hold, become U+FFFD.
std::string valid_utf8(std::string_view text);

/// `text` with its ASCII letters in lower case.
std::string lower_case(std::string text);

/// A path's text, for documents that refer to the file. Throws Error (input), with the remedy, if it is not UTF-8.
std::string require_utf8(const std::filesystem::path& path, const std::string& remedy);

/// A table of numbers from CSV, with each row's number in the file for messages (the header is row 1).
struct NumberTable {
    std::string file;
    std::vector<std::vector<double>> rows;
    std::vector<std::size_t> file_rows;
};

/// Parses CSV text whose header line is exactly `header` (names joined by commas). Lines may end in CR LF; a byte order
/// mark, blank lines and spaces around fields are ignored. Throws Error (input) naming `file`, the row and the expected
/// columns for another header, a wrong number of fields or a field that is no finite number.
NumberTable parse_number_table(std::string_view text, const std::string& file, const std::string& header);

/// The same from a file of at most 256 MiB.
NumberTable read_number_table(const std::filesystem::path& path, const std::string& header);

/// A text file of the source tree that the build put into the program: rowland_embed_files() in EmbedFiles.cmake.
struct EmbeddedFile {
    std::string_view name;  ///< path from the top of the source tree: "engine/post/shaders/exposure.frag.glsl"
    std::string_view text;
};

/// The text of the file called `name`, which must be among `files`.
std::string_view embedded_text(std::span<const EmbeddedFile> files, std::string_view name);

}  // namespace rowland
