// Every seed and what mutations make of it is read and sane, or refused in one line; in bounded time and memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "engine/core/file.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/environment.h"

namespace rowland::fuzz {
namespace {

using std::chrono::steady_clock;

constexpr unsigned kMostSeconds = 10;
constexpr std::uint64_t kMostBytes = 512 << 20;  ///< more than before

#if !defined(__has_feature)
#define __has_feature(feature) 0  // g++ 12
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || __has_feature(address_sanitizer)
constexpr bool kSanitized = true;  ///< shadow memory and quarantine count as well
#else
constexpr bool kSanitized = false;
#endif

/// How many mutations of its seeds a format is fed: ROWLAND_MUTATIONS of them, or as many as take ROWLAND_FUZZ_SECONDS;
/// by default 600, or with ROWLAND_TEST_ALL as many as take 5 s.
class Allowance {
 public:
    Allowance() {
        const char* count = std::getenv("ROWLAND_MUTATIONS");
        const char* seconds = std::getenv("ROWLAND_FUZZ_SECONDS");
        if (count != nullptr)
            count_ = std::max(1, std::atoi(count));
        else if (seconds != nullptr)
            until(std::max(1, std::atoi(seconds)));
        else if (std::getenv("ROWLAND_TEST_ALL") != nullptr)
            until(5);
    }
    bool allows(int mutation) const {
        return end_ ? mutation < kFewest || steady_clock::now() < *end_ : mutation < count_;
    }

 private:
    static constexpr int kFewest = 100;  ///< however slow the machine
    void until(int seconds) { end_ = steady_clock::now() + std::chrono::seconds(seconds); }

    int count_ = 600;
    std::optional<steady_clock::time_point> end_;
};

class HostileFile : public testing::TestWithParam<const Format*> {
 protected:
    /// The alarm ends the process: nothing waits for a reader that hangs.
    static bool read(std::span<const std::byte> bytes) {
        test::set_alarm(kSanitized ? 6 * kMostSeconds : kMostSeconds);
        const bool accepted = accepts(*GetParam(), bytes);
        test::set_alarm(0);
        return accepted;
    }
};

TEST_P(HostileFile, IsSaneOrRefused) {
    const std::vector<Seed> all = seeds(*GetParam());
    ASSERT_FALSE(all.empty());
    std::vector<const Seed*> sound;  // refused files are not worth damaging
    for (const Seed& seed : all) {
        SCOPED_TRACE(seed.name);
        if (read(seed.bytes)) sound.push_back(&seed);
    }
    ASSERT_FALSE(sound.empty()) << "no seed was read";
    // Damage to a large file seldom hits what steers its reader.
    const auto size = [](const Seed* seed) { return seed->bytes.size(); };
    const std::size_t most_damaged = std::max(std::size_t{128} << 10, size(std::ranges::min(sound, {}, size)));
    std::erase_if(sound, [&](const Seed* seed) { return size(seed) > most_damaged; });
    const std::uint64_t before = test::peak_memory_bytes();
    int read_mutations = 0;
    int mutations = 0;
    for (const Allowance allowance; allowance.allows(mutations); ++mutations) {
        const int i = mutations;
        const Seed& seed = *sound[static_cast<std::size_t>(i) % sound.size()];
        SCOPED_TRACE(seed.name + " mutated as " + std::to_string(i));
        const std::vector<std::byte> file = mutate(seed.bytes, static_cast<std::uint64_t>(i));
        if (const char* folder = std::getenv("ROWLAND_KEEP_MUTATION"))  // the last one remains after a crash
            write_file_atomic(std::filesystem::path(folder) / GetParam()->name, file);
        read_mutations += read(file) ? 1 : 0;
        if (!kSanitized) {
            ASSERT_LT(test::peak_memory_bytes() - before, kMostBytes);
        }
    }
    EXPECT_LT(read_mutations, mutations) << "nothing was refused";
    std::printf("%s: %zu seeds, %zu of them read; %d mutations, %d of them read\n", GetParam()->name, all.size(),
                sound.size(), mutations, read_mutations);
}

std::vector<const Format*> all_formats() {
    std::vector<const Format*> result;
    for (const Format& format : formats()) result.push_back(&format);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Formats, HostileFile, testing::ValuesIn(all_formats()), [](const auto& parameter) {
    std::string name = parameter.param->name;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

TEST(Mutate, GivesTheSameFileForTheSameNumber) {
    const std::vector<std::byte> bytes(1000, std::byte{'7'});
    int changed = 0;
    for (std::uint64_t number = 0; number < 100; ++number) {
        EXPECT_EQ(mutate(bytes, number), mutate(bytes, number));
        changed += mutate(bytes, number) != bytes ? 1 : 0;
    }
    EXPECT_GT(changed, 95);
}

}  // namespace
}  // namespace rowland::fuzz
