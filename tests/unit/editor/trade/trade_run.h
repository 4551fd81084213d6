#pragma once

#include "tests/support/program.h"

namespace rowland::test {

/// Runs rowland-trade with these arguments in a folder: test::command().
Ended run_trade(const std::filesystem::path& folder, const std::string& arguments);

/// A Radiance image of radiance 1, uncompressed.
std::string uniform_hdr(int width, int height);

/// Writes cd.json, and sky.hdr: a small probe with a sun.
void write_sweep_inputs(const std::filesystem::path& folder);

/// A small sweep's arguments but for the command: three settings, a picture of a few pixels, no times.
std::string small_sweep();

using Row = std::map<std::string, std::string>;
/// Rows of a CSV file with a header.
std::vector<Row> read_rows(const std::filesystem::path& path);

}  // namespace rowland::test
