// Sets RapidCheck up from the environment: ROWLAND_PROPERTY_SEED, a number or "random"; ROWLAND_PROPERTY_RUNS, cases
// for each property (30, or 100 with ROWLAND_TEST_ALL). RC_PARAMS, RapidCheck's own, overrides both: it is what a
// failure prints to be reproduced.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "engine/core/system.h"

namespace {

constexpr const char* kFixedSeed = "2006";  // the year of Lindsay & Agu
constexpr const char* kQuickRuns = "30";
constexpr const char* kAllRuns = "100";

std::string setting(const char* name, const char* fallback) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' ? value : fallback;
}

std::string seed() {
    std::string wanted = setting("ROWLAND_PROPERTY_SEED", kFixedSeed);
    if (wanted != "random") return wanted;
    std::random_device device;
    return std::to_string((std::uint64_t{device()} << 32U) | device());
}

}  // namespace

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    const char* const runs = std::getenv("ROWLAND_TEST_ALL") == nullptr ? kQuickRuns : kAllRuns;
    const std::string parameters =
        fmt::format("seed={} max_success={}", seed(), setting("ROWLAND_PROPERTY_RUNS", runs));
    rowland::set_default_variable("RC_PARAMS", parameters);
    const int result = RUN_ALL_TESTS();
    if (result != 0) fmt::print(stderr, "to run the same again: RC_PARAMS=\"{}\"\n", std::getenv("RC_PARAMS"));
    return result;
}
