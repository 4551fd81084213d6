#include "engine/core/byte_stream.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace rowland {

std::span<const std::byte> ByteReader::take(std::size_t size) {
    if (size > remaining()) fail_truncated(size);
    const auto part = data_.subspan(offset_, size);
    offset_ += size;
    return part;
}

void ByteReader::fail(std::string found, std::string expected) const {
    throw Error({.file = file_,
                 .place = fmt::format("byte {}", offset_),
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = {}});
}

void ByteReader::fail_truncated(std::uint64_t wanted) const {
    fail(fmt::format("{} bytes left", remaining()), fmt::format("{} more", wanted));
}

}  // namespace rowland
