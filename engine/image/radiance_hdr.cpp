#include "engine/image/radiance_hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/limits.h"
#include "engine/image/primaries.h"

// Format: Ward, "Real pixels", Graphics Gems II, 1991, and the Radiance source's color.c.

namespace rowland::image {

namespace {

constexpr std::size_t kMaximumLine = 4096;
constexpr std::size_t kMaximumHeaderLines = 256;

using Rgbe = std::array<std::uint8_t, 4>;

/// The bytes with a position; every read is checked.
class Cursor {
 public:
    Cursor(std::span<const std::byte> bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    std::uint8_t byte() {
        if (position_ >= bytes_.size()) fail("the end of the file", "more texels", "the file is truncated");
        return static_cast<std::uint8_t>(bytes_[position_++]);
    }
    Rgbe four() {
        Rgbe value;
        for (std::uint8_t& b : value) b = byte();
        return value;
    }
    void copy(std::size_t count, std::uint8_t* target, std::size_t stride) {
        if (count > remaining()) fail("the end of the file", "more texels", "the file is truncated");
        for (std::size_t i = 0; i < count; ++i) target[i * stride] = static_cast<std::uint8_t>(bytes_[position_ + i]);
        position_ += count;
    }
    /// The next line without its end.
    std::string_view line() {
        const std::size_t start = position_;
        while (position_ < bytes_.size() && static_cast<char>(bytes_[position_]) != '\n') {
            if (position_ - start > kMaximumLine) fail("a header line that does not end", "a text header");
            ++position_;
        }
        if (position_ == bytes_.size()) fail("the end of the file", "a text header and a resolution line");
        std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + start, position_ - start);
        ++position_;
        if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
        return text;
    }
    std::size_t remaining() const { return bytes_.size() - position_; }
    bool starts_new_encoding() const {
        return remaining() >= 4 && bytes_[position_] == std::byte{2} && bytes_[position_ + 1] == std::byte{2} &&
               (bytes_[position_ + 2] & std::byte{0x80}) == std::byte{0};
    }
    [[noreturn]] void fail(std::string found, std::string expected, std::string remedy = "") const {
        throw Error({.file = file_,
                     .place = fmt::format("byte {}", position_),
                     .found = std::move(found),
                     .expected = std::move(expected),
                     .remedy = std::move(remedy)});
    }
    const std::string& file() const { return file_; }

 private:
    std::span<const std::byte> bytes_;
    const std::string& file_;
    std::size_t position_ = 0;
};

/// What the header says beyond the size.
struct Header {
    glm::dvec3 divisor{1.0};  ///< product of EXPOSURE and COLORCORR lines
    std::optional<Primaries> primaries;
};

/// `count` numbers separated by blanks.
template <std::size_t Count>
std::array<double, Count> parse_numbers(std::string_view text, const Cursor& cursor, std::string_view what) {
    std::array<double, Count> numbers{};
    const char* position = text.data();
    const char* const end = text.data() + text.size();
    for (double& number : numbers) {
        while (position != end && (*position == ' ' || *position == '\t' || *position == '+')) ++position;
        const auto [stop, code] = std::from_chars(position, end, number);
        if (code != std::errc() || !std::isfinite(number))
            cursor.fail(fmt::format("{}={}", what, text.substr(0, 40)), fmt::format("{} numbers", Count));
        position = stop;
    }
    return numbers;
}

void read_header_line(std::string_view line, Header& header, const Cursor& cursor) {
    const std::size_t equals = line.find('=');
    if (line.empty() || line.front() == '#' || equals == std::string_view::npos) return;
    const std::string_view key = line.substr(0, equals);
    const std::string_view value = line.substr(equals + 1);
    if (key == "FORMAT" && value.find("32-bit_rle_rgbe") == std::string_view::npos)
        cursor.fail(fmt::format("FORMAT={}", value.substr(0, 40)), "FORMAT=32-bit_rle_rgbe",
                    "convert the picture to RGB (ra_xyze -r)");
    if (key == "EXPOSURE" || key == "COLORCORR") {
        glm::dvec3 factor(0.0);
        if (key == "EXPOSURE") {
            factor = glm::dvec3(parse_numbers<1>(value, cursor, key)[0]);
        } else {
            const auto numbers = parse_numbers<3>(value, cursor, key);
            factor = {numbers[0], numbers[1], numbers[2]};
        }
        header.divisor *= factor;
        for (int c = 0; c < 3; ++c)
            if (!(header.divisor[c] > 1e-30 && header.divisor[c] < 1e30))
                cursor.fail(fmt::format("{}={}", key, value.substr(0, 40)), "a positive exposure");
    }
    if (key == "PRIMARIES") {
        const auto n = parse_numbers<8>(value, cursor, key);
        const Primaries primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
        // Photoshop writes eight zeros, which say nothing.
        if (std::any_of(n.begin(), n.end(), [](double x) { return x != 0; })) {
            if (!is_usable(primaries))
                cursor.fail(fmt::format("PRIMARIES={}", value.substr(0, 80)), "chromaticities that span a triangle");
            header.primaries = primaries;
        }
    }
}

Header read_header(Cursor& cursor) {
    Header header;
    cursor.line();  // "#?RADIANCE" or "#?RGBE", checked by the caller
    for (std::size_t count = 0; count < kMaximumHeaderLines; ++count) {
        const std::string_view line = cursor.line();
        if (line.empty()) return header;
        read_header_line(line, header, cursor);
    }
    cursor.fail("a header without an end", fmt::format("an empty line after at most {} lines", kMaximumHeaderLines));
}

/// The order of texels in the file: scanlines along one axis, texels in them along the other.
struct Resolution {
    int width = 0;
    int height = 0;
    bool by_columns = false;  ///< a scanline is a column
    bool upward = false;      ///< rows are stored bottom first
    bool leftward = false;    ///< columns are stored right first
    int scanlines() const { return by_columns ? width : height; }
    int length() const { return by_columns ? height : width; }
};

Resolution read_resolution(Cursor& cursor) {
    const std::string text(cursor.line());
    std::istringstream stream(text);
    std::string axis[2];
    std::int64_t size[2] = {0, 0};
    std::string rest;
    const bool readable = static_cast<bool>(stream >> axis[0] >> size[0] >> axis[1] >> size[1]) && !(stream >> rest);
    const auto is_axis = [](const std::string& word, char letter) {
        return word.size() == 2 && (word[0] == '+' || word[0] == '-') && word[1] == letter;
    };
    const bool rows_first = readable && is_axis(axis[0], 'Y') && is_axis(axis[1], 'X');
    const bool columns_first = readable && is_axis(axis[0], 'X') && is_axis(axis[1], 'Y');
    if (!rows_first && !columns_first)
        cursor.fail(fmt::format("\"{}\"", text.substr(0, 40)), "a resolution line like \"-Y 512 +X 1024\"");
    const std::size_t y = rows_first ? 0 : 1;
    check_image_size(size[1 - y], size[y], cursor.file(), "resolution line");
    return {.width = static_cast<int>(size[1 - y]),
            .height = static_cast<int>(size[y]),
            .by_columns = columns_first,
            .upward = axis[y][0] == '+',
            .leftward = axis[1 - y][0] == '-'};
}

/// Flat texels with the old repeat counts: (1, 1, 1, n) repeats the texel before n times; directly following counts are
/// its higher bytes.
void read_old_scanline(Cursor& cursor, std::vector<Rgbe>& scanline) {
    std::size_t done = 0;
    unsigned shift = 0;
    while (done < scanline.size()) {
        const Rgbe texel = cursor.four();
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            scanline[done++] = texel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 24 ? std::size_t{texel[3]} << shift : scanline.size() + 1;
        if (done == 0) cursor.fail("a repeat count at the start of a scanline", "a texel to repeat");
        if (count > scanline.size() - done) cursor.fail("a repeat count beyond its scanline", "whole scanlines");
        std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(done), count, scanline[done - 1]);
        done += count;
        shift += 8;
    }
}

/// Four channels one after another, each in runs (128 + n, value) and dumps (n, values).
void read_new_scanline(Cursor& cursor, std::vector<Rgbe>& scanline) {
    const Rgbe start = cursor.four();
    const std::size_t length = std::size_t{start[2]} << 8 | start[3];
    if (length != scanline.size())
        cursor.fail(fmt::format("a scanline of {} texels", length), fmt::format("{}", scanline.size()));
    for (std::size_t channel = 0; channel < 4; ++channel) {
        std::size_t done = 0;
        while (done < length) {
            const std::uint8_t code = cursor.byte();
            const std::size_t count = code > 128 ? code - 128u : code;
            if (count == 0 || count > length - done) cursor.fail("a run beyond its scanline", "whole scanlines");
            if (code > 128) {
                const std::uint8_t value = cursor.byte();
                for (std::size_t i = 0; i < count; ++i) scanline[done + i][channel] = value;
            } else {
                cursor.copy(count, &scanline[done][channel], sizeof(Rgbe));
            }
            done += count;
        }
    }
}

/// The plain decode of most programs. Radiance itself adds ½ to each mantissa, which makes a typical probe .3–.5 %
/// brighter; the reference radiances this project is held to (PHYSICS §9) were made without it.
glm::vec3 decode(const Rgbe& texel, const glm::dvec3& factor) {
    if (texel[3] == 0) return glm::vec3(0.0f);
    const glm::dvec3 mantissa(texel[0], texel[1], texel[2]);
    return glm::vec3(mantissa * std::ldexp(1.0, texel[3] - 136) * factor);
}

/// The fewest bytes that `resolution` can be stored in: a texel and a repeat count a scanline.
std::uint64_t fewest_bytes(const Resolution& resolution) {
    return static_cast<std::uint64_t>(resolution.scanlines()) * (resolution.length() > 1 ? 8u : 4u);
}

/// Turns texels in the file's order into rows from the top.
std::vector<glm::vec3> oriented(std::vector<glm::vec3> stored, const Resolution& resolution) {
    if (!resolution.by_columns && !resolution.upward && !resolution.leftward) return stored;
    std::vector<glm::vec3> texels(stored.size());
    const auto width = static_cast<std::size_t>(resolution.width);
    const auto height = static_cast<std::size_t>(resolution.height);
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t y = resolution.upward ? height - 1 - row : row;
            const std::size_t x = resolution.leftward ? width - 1 - column : column;
            texels[row * width + column] = stored[resolution.by_columns ? x * height + y : y * width + x];
        }
    return texels;
}

}  // namespace

bool is_radiance_hdr(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{'#'} && bytes[1] == std::byte{'?'};
}

Image read_radiance_hdr(std::span<const std::byte> bytes, const std::string& file) {
    Cursor cursor(bytes, file);
    if (!is_radiance_hdr(bytes)) cursor.fail("no Radiance picture", "\"#?RADIANCE\" or \"#?RGBE\"");
    const Header header = read_header(cursor);
    const Resolution resolution = read_resolution(cursor);
    if (fewest_bytes(resolution) > cursor.remaining())
        cursor.fail(fmt::format("{} bytes left", cursor.remaining()),
                    fmt::format("at least {} for {} x {} texels", fewest_bytes(resolution), resolution.width,
                                resolution.height),
                    "the file is truncated");

    const glm::dvec3 factor = 1.0 / header.divisor;
    const auto length = static_cast<std::size_t>(resolution.length());
    std::vector<Rgbe> scanline(length);
    std::vector<glm::vec3> stored;  // grows as scanlines are really there
    for (int i = 0; i < resolution.scanlines(); ++i) {
        if (length >= 8 && length < 32768 && cursor.starts_new_encoding())
            read_new_scanline(cursor, scanline);
        else
            read_old_scanline(cursor, scanline);
        for (const Rgbe& texel : scanline) stored.push_back(decode(texel, factor));
    }
    Image image{resolution.width, resolution.height, oriented(std::move(stored), resolution)};
    if (header.primaries)
        if (const auto matrix = to_rec709(*header.primaries)) transform_colours(image, *matrix);
    return image;
}

Image read_radiance_hdr(const std::filesystem::path& path) {
    return read_radiance_hdr(read_file(path, kMaximumFileBytes), path.string());
}

}  // namespace rowland::image
