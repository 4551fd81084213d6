#pragma once

#include <cstdint>
#include <string>

namespace rowland::scene {

/// Limits the memory that one file may make us use. Every size that a file names is spent here before it is allocated,
/// so a small file cannot ask for gigabytes, neither at once nor by naming the same data a thousand times.
class MemoryBudget {
 public:
    static constexpr std::uint64_t kDefaultLimit = 512ULL << 20;

    explicit MemoryBudget(std::string file, std::uint64_t limit_bytes = kDefaultLimit);

    /// Takes `count` elements of `element_bytes`. Throws Error (input) at `pointer` if that is more than is left.
    void spend(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer);
    /// The same check for what is freed again before anything else is spent: nothing is taken.
    void require_left(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) const;

 private:
    std::string file_;
    std::uint64_t limit_;
    std::uint64_t left_;
};

}  // namespace rowland::scene
