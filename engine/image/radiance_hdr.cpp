#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "engine/colour/colour_space.h"
#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/image/image.h"

// Format: Ward, "Real pixels", Graphics Gems II, 1991, and the Radiance source's color.c.

namespace rowland::image {

namespace {

constexpr std::size_t kMaximumLine = 4096;
constexpr std::size_t kMaximumHeaderLines = 256;

using Rgbe = std::array<std::uint8_t, 4>;

/// The next line without its end.
std::string_view read_line(ByteReader& reader) {
    const auto rest = reader.peek(kMaximumLine);
    const auto* text = reinterpret_cast<const char*>(rest.data());
    const auto* end = static_cast<const char*>(rest.empty() ? nullptr : std::memchr(text, '\n', rest.size()));
    if (end == nullptr && rest.size() == kMaximumLine) reader.fail("a header line that does not end", "a text header");
    if (end == nullptr) reader.fail("the end of the file", "a text header and a resolution line");
    std::string_view line(text, static_cast<std::size_t>(end - text));
    reader.take(line.size() + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

Rgbe read_texel(ByteReader& reader) {
    Rgbe texel;
    std::memcpy(texel.data(), reader.take(texel.size()).data(), texel.size());
    return texel;
}

struct Header {
    glm::dvec3 divisor{1.0};  ///< product of EXPOSURE and COLORCORR lines
    std::optional<colour::Primaries> primaries;
};

/// `Count` numbers separated by blanks; `what` is the key, for messages.
template <std::size_t Count>
std::array<double, Count> parse_numbers(std::string_view text, const ByteReader& reader, std::string_view what) {
    std::array<double, Count> numbers{};
    const char* position = text.data();
    const char* const end = text.data() + text.size();
    for (double& number : numbers) {
        while (position != end && (*position == ' ' || *position == '\t' || *position == '+')) ++position;
        const auto [stop, code] = std::from_chars(position, end, number);
        if (code != std::errc() || !std::isfinite(number))
            reader.fail(fmt::format("{}={}", what, text.substr(0, 40)), fmt::format("{} numbers", Count));
        position = stop;
    }
    return numbers;
}

void read_header_line(std::string_view line, Header& header, const ByteReader& reader) {
    const std::size_t equals = line.find('=');
    if (line.empty() || line.front() == '#' || equals == std::string_view::npos) return;
    const std::string_view key = line.substr(0, equals);
    const std::string_view value = line.substr(equals + 1);
    if (key == "FORMAT" && value.find("32-bit_rle_rgbe") == std::string_view::npos)
        refuse_input(reader.file(), "FORMAT", fmt::format("{}", value.substr(0, 40)), "32-bit_rle_rgbe",
                     "convert the picture to RGB (ra_xyze -r)");
    if (key == "EXPOSURE" || key == "COLORCORR") {
        glm::dvec3 factor(0.0);
        if (key == "EXPOSURE") {
            factor = glm::dvec3(parse_numbers<1>(value, reader, key)[0]);
        } else {
            const auto numbers = parse_numbers<3>(value, reader, key);
            factor = {numbers[0], numbers[1], numbers[2]};
        }
        header.divisor *= factor;
        for (int c = 0; c < 3; ++c)
            if (!(header.divisor[c] > 1e-30 && header.divisor[c] < 1e30))
                reader.fail(fmt::format("{}={}", key, value.substr(0, 40)), "a positive exposure");
    }
    if (key == "PRIMARIES") {
        const auto n = parse_numbers<8>(value, reader, key);
        const colour::Primaries primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
        // Photoshop writes eight zeros for unknown primaries.
        if (std::any_of(n.begin(), n.end(), [](double x) { return x != 0; })) {
            if (!colour::is_usable(primaries))
                reader.fail(fmt::format("PRIMARIES={}", value.substr(0, 80)), "chromaticities that span a triangle");
            header.primaries = primaries;
        }
    }
}

Header read_header(ByteReader& reader) {
    Header header;
    read_line(reader);  // "#?RADIANCE" or "#?RGBE", checked by the caller
    for (std::size_t count = 0; count < kMaximumHeaderLines; ++count) {
        const std::string_view line = read_line(reader);
        if (line.empty()) return header;
        read_header_line(line, header, reader);
    }
    reader.fail("a header without an end", fmt::format("an empty line after at most {} lines", kMaximumHeaderLines));
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

Resolution read_resolution(ByteReader& reader) {
    const std::string text(read_line(reader));
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
        reader.fail(fmt::format("\"{}\"", text.substr(0, 40)), "a resolution line like \"-Y 512 +X 1024\"");
    const std::size_t y = rows_first ? 0 : 1;
    check_image_size(size[1 - y], size[y], reader.file(), "resolution line");
    return {.width = static_cast<int>(size[1 - y]),
            .height = static_cast<int>(size[y]),
            .by_columns = columns_first,
            .upward = axis[y][0] == '+',
            .leftward = axis[1 - y][0] == '-'};
}

/// Flat texels with the old repeat counts: (1, 1, 1, n) repeats the texel before it n times; a count directly after
/// another holds the next higher byte of n.
void read_old_scanline(ByteReader& reader, std::vector<Rgbe>& scanline) {
    std::size_t done = 0;
    unsigned shift = 0;
    while (done < scanline.size()) {
        const Rgbe texel = read_texel(reader);
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            scanline[done++] = texel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 24 ? std::size_t{texel[3]} << shift : scanline.size() + 1;
        if (done == 0) reader.fail("a repeat count at the start of a scanline", "a texel to repeat");
        if (count > scanline.size() - done) reader.fail("a repeat count beyond its scanline", "whole scanlines");
        std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(done), count, scanline[done - 1]);
        done += count;
        shift += 8;
    }
}

/// Four channels one after another, each as runs (128 + n, value) and literal values (n, values).
void read_new_scanline(ByteReader& reader, std::vector<Rgbe>& scanline) {
    const Rgbe start = read_texel(reader);
    const std::size_t length = std::size_t{start[2]} << 8 | start[3];
    if (length != scanline.size())
        reader.fail(fmt::format("a scanline of {} texels", length), fmt::format("{}", scanline.size()));
    for (std::size_t channel = 0; channel < 4; ++channel) {
        std::size_t done = 0;
        while (done < length) {
            const auto code = reader.value<std::uint8_t>();
            const std::size_t count = code > 128 ? code - 128u : code;
            if (count == 0 || count > length - done) reader.fail("a run beyond its scanline", "whole scanlines");
            const auto values = reader.take(code > 128 ? 1 : count);
            for (std::size_t i = 0; i < count; ++i)
                scanline[done + i][channel] = std::to_integer<std::uint8_t>(values[code > 128 ? 0 : i]);
            done += count;
        }
    }
}

bool starts_new_encoding(const ByteReader& reader) {
    const auto next = reader.peek(4);
    return next.size() == 4 && next[0] == std::byte{2} && next[1] == std::byte{2} &&
           (next[2] & std::byte{0x80}) == std::byte{0};
}

/// See read_radiance_hdr(). The ½ that Radiance adds to each mantissa would make a typical probe .3–.5 % brighter.
glm::vec3 decode(const Rgbe& texel, const glm::dvec3& factor) {
    if (texel[3] == 0) return glm::vec3(0.0f);
    const glm::dvec3 mantissa(texel[0], texel[1], texel[2]);
    return glm::vec3(mantissa * std::ldexp(1.0, texel[3] - 136) * factor);
}

/// The fewest bytes that an image of this size can be stored in: per scanline a texel and a repeat count.
std::uint64_t fewest_bytes(const Resolution& resolution) {
    return static_cast<std::uint64_t>(resolution.scanlines()) * (resolution.length() > 1 ? 8u : 4u);
}

/// Decodes a scanline into the image.
void store(const std::vector<Rgbe>& scanline, int number, const Resolution& resolution, const glm::dvec3& factor,
           Image& image) {
    for (int i = 0; i < resolution.length(); ++i) {
        const int x = resolution.by_columns ? number : i;
        const int y = resolution.by_columns ? i : number;
        image.at(resolution.leftward ? image.width - 1 - x : x, resolution.upward ? image.height - 1 - y : y) =
            decode(scanline[static_cast<std::size_t>(i)], factor);
    }
}

}  // namespace

bool is_radiance_hdr(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{'#'} && bytes[1] == std::byte{'?'};
}

Image read_radiance_hdr(std::span<const std::byte> bytes, const std::string& file) {
    ByteReader reader(bytes, file);
    if (!is_radiance_hdr(bytes)) reader.fail("no Radiance picture", "\"#?RADIANCE\" or \"#?RGBE\"");
    const Header header = read_header(reader);
    const Resolution resolution = read_resolution(reader);
    if (fewest_bytes(resolution) > reader.remaining())
        refuse_input(file, fmt::format("byte {}", reader.offset()), fmt::format("{} bytes left", reader.remaining()),
                     fmt::format("at least {} for {} x {} texels", fewest_bytes(resolution), resolution.width,
                                 resolution.height),
                     "the file is truncated");
    check_decoded_bytes(resolution.width, resolution.height,
                        sizeof(glm::vec3) * static_cast<std::uint64_t>(resolution.width) *
                            static_cast<std::uint64_t>(resolution.height),
                        bytes.size(), file);

    const glm::dvec3 factor = 1.0 / header.divisor;
    std::vector<Rgbe> scanline(static_cast<std::size_t>(resolution.length()));
    Image image = make_image(resolution.width, resolution.height);
    for (int i = 0; i < resolution.scanlines(); ++i) {
        if (scanline.size() >= 8 && scanline.size() < 32768 && starts_new_encoding(reader))
            read_new_scanline(reader, scanline);
        else
            read_old_scanline(reader, scanline);
        store(scanline, i, resolution, factor, image);
    }
    if (header.primaries)
        if (const auto matrix = colour::to_rec709(*header.primaries)) transform_colours(image, *matrix);
    return image;
}

}  // namespace rowland::image
