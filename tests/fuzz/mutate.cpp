#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <random>
#include <string_view>

namespace rowland::fuzz {

namespace {

using Bytes = std::vector<std::byte>;

class Mutation {
 public:
    Mutation(std::span<const std::byte> bytes, std::uint64_t number)
        : bytes_(bytes.begin(), bytes.end()), most_(bytes.size() + (64 << 10)), random_(number) {}

    Bytes take() {
        // Half of them small, as what is still nearly sound gets furthest.
        if (below(2) == 0) {
            below(2) == 0 ? replace_number() : flip_bits(1);
            return std::move(bytes_);
        }
        const std::size_t times = 1 + below(4);
        for (std::size_t i = 0; i < times; ++i) apply();
        if (bytes_.size() > most_) bytes_.resize(most_);
        return std::move(bytes_);
    }

 private:
    /// Uniform enough; distributions of the library differ from one to another.
    std::size_t below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(random_() % end); }
    std::size_t place() { return below(bytes_.size()); }

    void apply() {
        if (bytes_.empty()) return;
        switch (below(8)) {
            case 0:
                return flip_bits(1 + below(8));
            case 1:
                return bytes_.resize(place());
            case 2:
                return overwrite_count();
            case 3:
                return replace_number();
            case 4:
                return insert(place(), copy(place(), 1 + below(256)));
            case 5:
                return remove(place(), 1 + below(256));
            case 6:
                return exchange();
            default:
                return open_brackets();
        }
    }

    void flip_bits(std::size_t times) {
        if (bytes_.empty()) return;
        for (std::size_t i = 0; i < times; ++i) bytes_[place()] ^= static_cast<std::byte>(1U << below(8));
    }

    void overwrite_count() {
        constexpr std::array<std::uint64_t, 8> kCounts{0,          1,          0x7F,       0x7FFFFFFF,
                                                       0x80000000, 0xFFFFFFFF, 0x10000000, 0x7FFFFFFFFFFFFFFF};
        const std::uint64_t count = kCounts.at(below(kCounts.size()));
        const std::size_t size = std::min<std::size_t>(std::size_t{1} << below(4), bytes_.size());
        std::memcpy(bytes_.data() + below(bytes_.size() - size + 1), &count, size);
    }

    void replace_number() {
        constexpr std::array<std::string_view, 12> kNumbers{
            "0",    "-1",  "4294967296", "2147483648", "18446744073709551616", "1e999", "1e38", "1e-50",
            "-0.0", "nan", "\"\"",       "[[]]"};
        const auto digit = [](std::byte byte) { return std::isdigit(static_cast<unsigned char>(byte)) != 0; };
        if (bytes_.empty()) return;
        const auto begin = std::find_if(bytes_.begin() + static_cast<std::ptrdiff_t>(place()), bytes_.end(), digit);
        const auto end = std::find_if_not(begin, bytes_.end(), digit);
        const auto at = static_cast<std::size_t>(begin - bytes_.begin());
        bytes_.erase(begin, end);
        insert(at, as_bytes(kNumbers.at(below(kNumbers.size()))));
    }

    void exchange() {
        const std::size_t size = std::min<std::size_t>(1 + below(64), bytes_.size());
        const std::size_t a = below(bytes_.size() - size + 1);
        const std::size_t b = below(bytes_.size() - size + 1);
        const Bytes kept = copy(a, size);
        std::memmove(bytes_.data() + a, bytes_.data() + b, size);
        std::copy(kept.begin(), kept.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(b));
    }

    void open_brackets() {
        constexpr std::size_t kDepth = 10000;
        insert(place(), Bytes(kDepth, below(2) == 0 ? std::byte{'['} : std::byte{'{'}));
    }

    static Bytes as_bytes(std::string_view text) {
        const auto* begin = reinterpret_cast<const std::byte*>(text.data());
        return {begin, begin + text.size()};
    }
    Bytes copy(std::size_t at, std::size_t size) const {
        const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at);
        return {begin, begin + static_cast<std::ptrdiff_t>(std::min(size, bytes_.size() - at))};
    }
    void insert(std::size_t at, const Bytes& piece) {
        bytes_.insert(bytes_.begin() + static_cast<std::ptrdiff_t>(at), piece.begin(), piece.end());
    }
    void remove(std::size_t at, std::size_t size) {
        const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at);
        bytes_.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(size, bytes_.size() - at)));
    }

    Bytes bytes_;
    std::size_t most_;
    std::mt19937_64 random_;
};

}  // namespace

std::vector<std::byte> mutate(std::span<const std::byte> bytes, std::uint64_t number) {
    return Mutation(bytes, number).take();
}

}  // namespace rowland::fuzz
