// libFuzzer's entry. ROWLAND_FUZZ_FORMAT names what is fuzzed, so that one program does for all.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/format.h"

namespace {

const rowland::fuzz::Format& chosen() {
    const char* name = std::getenv("ROWLAND_FUZZ_FORMAT");
    if (name != nullptr)
        for (const rowland::fuzz::Format& format : rowland::fuzz::formats())
            if (std::string_view(format.name) == name) return format;
    std::fputs("error: ROWLAND_FUZZ_FORMAT names no format; expected one of", stderr);
    for (const rowland::fuzz::Format& format : rowland::fuzz::formats()) std::fprintf(stderr, " %s", format.name);
    std::fputs("; use ./rowland fuzz\n", stderr);
    std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const rowland::fuzz::Format& format = chosen();
    rowland::fuzz::accepts(format, std::as_bytes(std::span(data, size)));
    return 0;
}
