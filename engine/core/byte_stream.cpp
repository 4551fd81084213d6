#include "engine/core/byte_stream.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace rowland {

std::span<const std::byte> ByteReader::take(std::size_t size) {
    if (size > remaining()) fail_truncated(size, 1);
    const auto part = data_.subspan(offset_, size);
    offset_ += size;
    return part;
}

void ByteReader::fail(std::string found, std::string expected) const {
    refuse_input(file_, fmt::format("byte {}", offset_), std::move(found), std::move(expected));
}

bool ByteReader::truth() {
    const auto x = value<std::uint8_t>();
    if (x <= 1) return x == 1;
    --offset_;
    fail(fmt::format("{}", x), "0 or 1");
}

void ByteReader::fail_truncated(std::uint64_t count, std::size_t element_size) const {
    fail(fmt::format("{} bytes left", remaining()),
         element_size == 1 ? fmt::format("{} bytes", count) : fmt::format("{} times {} bytes", count, element_size));
}

}  // namespace rowland
