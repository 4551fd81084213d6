#include "tests/unit/editor/trade/trade_run.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "engine/core/file.h"

namespace rowland::test {

TradeRun run_trade(const std::filesystem::path& folder, const std::string& arguments) {
    const auto messages = folder / "messages";
    const std::string command =
        fmt::format("cd '{}' && '{}' {} 2>'{}'", folder.string(), ROWLAND_TRADE, arguments, messages.string());
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return {};
    TradeRun run;
    std::array<char, 4096> buffer;
    for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        run.output.append(buffer.data(), size);
    const int status = ::pclose(pipe);
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    run.messages = read_text_file(messages, 1 << 20);
    return run;
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
    const auto cells = [](const std::string& line) {
        std::vector<std::string> result(1);
        for (const char c : line)
            if (c == ',')
                result.emplace_back();
            else
                result.back() += c;
        return result;
    };
    std::istringstream text(read_text_file(path, 1 << 24));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> header = cells(line);
    std::vector<Row> rows;
    while (std::getline(text, line)) {
        const std::vector<std::string> values = cells(line);
        Row row;
        for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = values.at(i);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace rowland::test
