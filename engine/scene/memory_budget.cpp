#include "engine/scene/memory_budget.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace rowland::scene {

MemoryBudget::MemoryBudget(std::string file, std::uint64_t limit_bytes)
    : file_(std::move(file)), limit_(limit_bytes), left_(limit_bytes) {}

void MemoryBudget::spend(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) {
    require_left(count, element_bytes, pointer);
    left_ -= count * element_bytes;
}

void MemoryBudget::require_left(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) const {
    if (element_bytes != 0 && count > left_ / element_bytes)
        refuse_input(file_, pointer, fmt::format("{} elements of {} bytes", count, element_bytes),
                     fmt::format("at most {} bytes in the whole scene", limit_),
                     "split the scene, or correct the count");
}

}  // namespace rowland::scene
