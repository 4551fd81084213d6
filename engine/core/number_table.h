#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rowland {

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

}  // namespace rowland
