#include "tests/unit/editor/trade/trade_run.h"

#include <fmt/format.h>

#include "engine/core/file.h"
#include "tests/support/csv.h"

namespace rowland::test {

Ended run_trade(const std::filesystem::path& folder, const std::string& arguments) {
    return run(command(ROWLAND_TRADE, arguments), {.folder = folder, .limit = std::chrono::minutes(10)});
}

std::string uniform_hdr(int width, int height) {
    std::string text = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    for (int i = 0; i < width * height; ++i) text += "\x80\x80\x80\x81";
    return text;
}

void write_sweep_inputs(const std::filesystem::path& folder) {
    write_file_atomic(folder / "cd.json",
                      R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})");
    constexpr int kWidth = 32;
    constexpr int kHeight = 16;
    std::string hdr = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", kHeight, kWidth);
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column) {
            const bool sun = row == 4 && column == 20;
            const bool sky = row < kHeight / 2;
            // RGBE: 128 and 129 is 1.
            hdr += sun ? "\x80\x78\x70\x87" : (sky ? "\x50\x70\xa0\x80" : "\x40\x38\x30\x7f");
        }
    write_file_atomic(folder / "sky.hdr", hdr);
}

std::string small_sweep() {
    return "--material cd.json --probe sky.hdr --setting spikes/bands=3/spikes=2/view_resolution=8 "
           "--setting arc/bands=4/rank=8 --setting planar/map_resolution=64 --picture-size 24 14 --output results";
}

std::vector<Row> read_rows(const std::filesystem::path& path) {
    const Csv table = read_csv(path);
    std::vector<Row> rows(table.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        for (const std::string& column : table.header) rows[i][column] = table.text(i, column);
    return rows;
}

}  // namespace rowland::test
