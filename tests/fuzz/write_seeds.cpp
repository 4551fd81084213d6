// Writes the seeds of every format to FOLDER/FORMAT/, for libFuzzer.
#include <cstdio>

#include "engine/core/file.h"
#include "engine/core/program.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: rowland-fuzz-seeds FOLDER\nexample: rowland-fuzz-seeds build/fuzz/corpus\n", stderr);
        return 2;
    }
    return rowland::run_program([&] {
        for (const rowland::fuzz::Format& format : rowland::fuzz::formats()) {
            const std::filesystem::path folder = std::filesystem::path(argv[1]) / format.name;
            std::filesystem::create_directories(folder);
            int number = 0;
            for (const rowland::fuzz::Seed& seed : rowland::fuzz::seeds(format))
                rowland::write_file_atomic(folder / ("seed_" + std::to_string(number++)), seed.bytes);
            std::printf("%s\n", format.name);
        }
        return 0;
    });
}
