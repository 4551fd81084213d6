#include "engine/core/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland {

std::string valid_utf8(std::string_view text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string require_utf8(const std::filesystem::path& path, const std::string& remedy) {
    std::string text = path.string();
    if (valid_utf8(text) != text) refuse_input(text, {}, "a name that is not UTF-8", "one that JSON can hold", remedy);
    return text;
}

namespace {

constexpr std::uint64_t kMaximumFileBytes = std::uint64_t{256} << 20;

std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const auto end = line.find(',');
        fields.push_back(trim(line.substr(0, end)));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

[[noreturn]] void fail(const std::string& file, std::size_t row, std::string found, std::string expected) {
    refuse_input(file, fmt::format("row {}", row), std::move(found), std::move(expected));
}

std::string quoted(std::string_view text) {
    return fmt::format("\"{}\"", text.substr(0, 60));
}

std::vector<double> parse_row(std::string_view line, const NumberTable& table, std::size_t row,
                              const std::string& header, const std::vector<std::string_view>& columns) {
    const auto fields = split(line);
    if (fields.size() != columns.size())
        fail(table.file, row, fmt::format("{} fields", fields.size()),
             fmt::format("{} columns: {}", columns.size(), header));
    std::vector<double> values;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto value = parse_number(fields[i]);
        if (!value)
            fail(table.file, row, fmt::format("{} in column {}", quoted(fields[i]), columns[i]), "a finite number");
        values.push_back(*value);
    }
    return values;
}

}  // namespace

NumberTable parse_number_table(std::string_view text, const std::string& file, const std::string& header) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    NumberTable table{.file = file, .rows = {}, .file_rows = {}};
    const auto columns = split(header);
    bool header_seen = false;
    for (std::size_t row = 1; !text.empty(); ++row) {
        const auto end = text.find('\n');
        const std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty()) continue;
        if (!header_seen) {
            if (split(line) != columns) fail(table.file, row, quoted(line), "the header " + header);
            header_seen = true;
            continue;
        }
        table.rows.push_back(parse_row(line, table, row, header, columns));
        table.file_rows.push_back(row);
    }
    if (!header_seen) fail(table.file, 1, "an empty file", "the header " + header);
    return table;
}

NumberTable read_number_table(const std::filesystem::path& path, const std::string& header) {
    return parse_number_table(read_text_file(path, kMaximumFileBytes), path.string(), header);
}

std::string_view embedded_text(std::span<const EmbeddedFile> files, std::string_view name) {
    for (const EmbeddedFile& file : files)
        if (file.name == name) return file.text;
    check_failed(__FILE__, __LINE__, fmt::format("no embedded file \"{}\"", name));
}

}  // namespace rowland
