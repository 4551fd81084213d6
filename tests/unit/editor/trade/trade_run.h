#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rowland::test {

struct TradeRun {
    int exit_code = -1;
    std::string output;
    std::string messages;
};

/// Runs rowland-trade in a folder.
TradeRun run_trade(const std::filesystem::path& folder, const std::string& arguments);

/// Writes cd.json, and sky.hdr: a small probe with a sun.
void write_sweep_inputs(const std::filesystem::path& folder);

/// A small sweep's arguments but for the command: three settings, a picture of a few pixels, no times.
std::string small_sweep();

using Row = std::map<std::string, std::string>;
/// Rows of a CSV file with a header.
std::vector<Row> read_rows(const std::filesystem::path& path);

}  // namespace rowland::test
