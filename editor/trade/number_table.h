#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rowland::trade {

/// A table of numbers from a CSV file, with the row of the file that each stands in for messages (the header is row 1).
struct NumberTable {
    std::string file;
    std::vector<std::vector<double>> rows;
    std::vector<std::size_t> file_rows;
};

/// Reads a CSV file whose header line is exactly `header` (names joined by commas). Throws Error (input) naming the
/// file, the row, and the expected columns for another header, a wrong number of fields or a field that is no finite
/// number.
NumberTable read_number_table(const std::filesystem::path& path, const std::string& header);

}  // namespace rowland::trade
