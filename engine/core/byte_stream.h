#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rowland {

static_assert(std::endian::native == std::endian::little, "values are copied as they lie in memory");

/// Appends little-endian values to a buffer.
class ByteWriter {
 public:
    template <typename T>
    requires std::is_arithmetic_v<T>
    void value(T x) {
        const auto* raw = reinterpret_cast<const std::byte*>(&x);
        data_.insert(data_.end(), raw, raw + sizeof x);
    }
    /// Count (u64), then the elements.
    template <typename T>
    requires std::is_trivially_copyable_v<T>
    void array(std::span<const T> values) {
        value<std::uint64_t>(values.size());
        const auto raw = std::as_bytes(values);
        data_.insert(data_.end(), raw.begin(), raw.end());
    }
    void text(std::string_view characters) { array(std::span(characters.data(), characters.size())); }

    std::vector<std::byte> take() { return std::move(data_); }
    const std::vector<std::byte>& data() const { return data_; }

 private:
    std::vector<std::byte> data_;
};

/// Reads what ByteWriter wrote, from bytes that may be hostile: every size is checked before it is used.
/// Throws Error (input) naming `file` and the byte offset.
class ByteReader {
 public:
    ByteReader(std::span<const std::byte> data, std::string file) : data_(data), file_(std::move(file)) {}

    template <typename T>
    requires std::is_arithmetic_v<T> T value() {
        if constexpr (std::is_same_v<T, bool>) {
            return truth();
        } else {
            T x;
            std::memcpy(&x, take(sizeof x).data(), sizeof x);
            return x;
        }
    }
    template <typename T>
    requires std::is_trivially_copyable_v<T> std::vector<T> array() {
        const auto count = value<std::uint64_t>();
        if (count > remaining() / sizeof(T)) fail_truncated(count, sizeof(T));
        std::vector<T> values(static_cast<std::size_t>(count));
        const auto raw = take(values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), raw.data(), raw.size());
        return values;
    }
    std::string text() {
        const auto characters = array<char>();
        return {characters.begin(), characters.end()};
    }
    std::span<const std::byte> take(std::size_t size);
    /// The next `size` bytes, or as many as are left; the offset stays.
    std::span<const std::byte> peek(std::size_t size) const {
        return data_.subspan(offset_, size < remaining() ? size : remaining());
    }
    std::size_t remaining() const { return data_.size() - offset_; }
    std::size_t offset() const { return offset_; }
    const std::string& file() const { return file_; }
    /// Throws Error at the present offset.
    [[noreturn]] void fail(std::string found, std::string expected) const;

 private:
    bool truth();
    [[noreturn]] void fail_truncated(std::uint64_t count, std::size_t element_size) const;

    std::span<const std::byte> data_;
    std::string file_;
    std::size_t offset_ = 0;
};

}  // namespace rowland
