#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rowland::test {

/// A table of test data: a header line, then rows of as many fields. Fields may be quoted.
struct Csv {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;

    const std::string& text(std::size_t row, const std::string& column) const;
    double number(std::size_t row, const std::string& column) const;
    int integer(std::size_t row, const std::string& column) const;
};

/// Throws std::runtime_error if a row has another number of fields than the header.
Csv read_csv(const std::filesystem::path& path, char separator = ',');

}  // namespace rowland::test
