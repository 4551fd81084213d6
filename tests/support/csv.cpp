#include "tests/support/csv.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace rowland::test {

namespace {

std::vector<std::string> split(const std::string& line, char separator, bool quotes) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (quotes && c == '"')
            quoted = !quoted;
        else if (c == separator && !quoted)
            fields.emplace_back();
        else if (c != '\r')
            fields.back() += c;
    }
    return fields;
}

}  // namespace

const std::string& Csv::text(std::size_t row, const std::string& column) const {
    const auto it = std::find(header.begin(), header.end(), column);
    if (it == header.end()) throw std::runtime_error("no column " + column);
    return rows.at(row)[static_cast<std::size_t>(it - header.begin())];
}

double Csv::number(std::size_t row, const std::string& column) const {
    return std::stod(text(row, column));
}
int Csv::integer(std::size_t row, const std::string& column) const {
    return std::stoi(text(row, column));
}

Csv read_csv(const std::filesystem::path& path, char separator) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot open " + path.string());
    // A semicolon-separated table holds JSON, whose quotes belong to the field.
    const bool quotes = separator == ',';
    Csv csv;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line == "\r") continue;
        auto fields = split(line, separator, quotes);
        if (csv.header.empty()) {
            csv.header = std::move(fields);
            continue;
        }
        if (fields.size() != csv.header.size()) throw std::runtime_error("ragged row in " + path.string());
        csv.rows.push_back(std::move(fields));
    }
    return csv;
}

}  // namespace rowland::test
