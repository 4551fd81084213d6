#include "engine/asset/container.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

// Layout, little-endian:
//   magic              8 bytes
//   container version  u32
//   type               text (u64 length, characters)
//   type version       u32
//   content hash       u64 low, u64 high
//   payload size       u64, before compression
//   stored size        u64, after it
//   checksum           u64 low, u64 high: XXH3-128 of all other bytes of the file, in order
//   payload            one zstd frame

namespace rowland::asset {

namespace {

// The last byte stops a text viewer, as in PNG.
constexpr std::array<char, 8> kMagic = {'R', 'O', 'W', 'L', 'A', 'N', 'D', '\x1a'};
constexpr std::uint32_t kContainerVersion = 1;
constexpr std::uint64_t kMaximumPayloadSize = std::uint64_t{1} << 30;
constexpr std::size_t kMaximumTypeSize = 64;
/// All fields but the payload, rounded up.
constexpr std::size_t kMaximumHeaderSize = 256;
constexpr const char* kRecook = "cook it again: ./rowland cook";

/// Higher levels compress floating-point tables hardly better and are much slower.
constexpr int kCompressionLevel = 9;

// The densest a zstd frame gets is one 4-byte run-length block for each 128 KiB (RFC 8878, 3.1.1.2).
constexpr std::uint64_t kMaximumBlockSize = std::uint64_t{128} << 10;
constexpr std::uint64_t kMinimumStoredBlockSize = 4;

std::vector<std::byte> compress(std::span<const std::byte> payload) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    if (!context) throw std::bad_alloc();
    // The rest has its defaults: one thread, no dictionary, no checksum in the frame.
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
    std::vector<std::byte> stored(ZSTD_compressBound(payload.size()));
    const std::size_t size =
        ZSTD_compress2(context.get(), stored.data(), stored.size(), payload.data(), payload.size());
    ROWLAND_CHECK(!ZSTD_isError(size), ZSTD_getErrorName(size));
    stored.resize(size);
    return stored;
}

std::vector<std::byte> decompress(std::span<const std::byte> stored, std::uint64_t size, const std::string& file) {
    std::vector<std::byte> payload(static_cast<std::size_t>(size));
    const std::size_t done = ZSTD_decompress(payload.data(), payload.size(), stored.data(), stored.size());
    if (ZSTD_isError(done)) refuse_input(file, "payload", ZSTD_getErrorName(done), "a zstd frame");
    if (done != payload.size())
        refuse_input(file, "payload", fmt::format("{} bytes", done), fmt::format("{} bytes", payload.size()));
    return payload;
}

/// The fields between magic and checksum.
struct Fields {
    Header header;
    std::uint64_t payload_size = 0;
    std::uint64_t stored_size = 0;
};

void write_fields(ByteWriter& writer, const Fields& fields) {
    writer.value(kContainerVersion);
    writer.text(fields.header.type);
    writer.value(fields.header.type_version);
    writer.value(fields.header.content_hash.low);
    writer.value(fields.header.content_hash.high);
    writer.value(fields.payload_size);
    writer.value(fields.stored_size);
}

void check_version(const std::string& of, std::uint32_t found, std::uint32_t expected, const std::string& file) {
    if (found == expected) return;
    const char* age = found > expected ? "newer" : "older";
    refuse_input(file, "header", fmt::format("{} version {}, {} than this program's", of, found, age),
                 fmt::format("version {}", expected), kRecook);
}

Fields read_fields(ByteReader& reader) {
    check_version("container", reader.value<std::uint32_t>(), kContainerVersion, reader.file());
    Fields fields;
    fields.header.type = reader.text();
    fields.header.type_version = reader.value<std::uint32_t>();
    fields.header.content_hash.low = reader.value<std::uint64_t>();
    fields.header.content_hash.high = reader.value<std::uint64_t>();
    fields.payload_size = reader.value<std::uint64_t>();
    fields.stored_size = reader.value<std::uint64_t>();
    return fields;
}

void check_sizes(const Fields& fields, const std::string& file) {
    if (fields.header.type.empty() || fields.header.type.size() > kMaximumTypeSize)
        refuse_input(file, "header", fmt::format("a type name of {} characters", fields.header.type.size()),
                     fmt::format("1 to {} characters", kMaximumTypeSize));
    if (fields.payload_size > kMaximumPayloadSize)
        refuse_input(file, "header", fmt::format("a payload of {} bytes", fields.payload_size),
                     fmt::format("at most {} bytes", kMaximumPayloadSize));
    if (fields.payload_size / kMaximumBlockSize > fields.stored_size / kMinimumStoredBlockSize)
        refuse_input(file, "header",
                     fmt::format("a payload of {} bytes in {}", fields.payload_size, fields.stored_size),
                     "no more than zstd can hold");
}

Hash128 checksum(std::span<const std::byte> before, std::span<const std::byte> after) {
    return Hasher().bytes(before).bytes(after).digest();
}

/// Whether the bytes are the beginning of the magic or begin with it.
bool begins_like_magic(std::span<const std::byte> bytes) {
    const std::size_t size = std::min(bytes.size(), kMagic.size());
    return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), kMagic.begin(),
                      [](std::byte a, char b) { return a == static_cast<std::byte>(b); });
}

/// unpack(), but its errors lack the remedy.
CookedAsset parse(std::span<const std::byte> bytes, const std::string& file) {
    if (!begins_like_magic(bytes)) refuse_input(file, "byte 0", "not a cooked asset", "one that ./rowland cook wrote");
    ByteReader reader(bytes, file);
    reader.take(kMagic.size());
    Fields fields = read_fields(reader);
    const auto checked = bytes.first(reader.offset());
    Hash128 expected;
    expected.low = reader.value<std::uint64_t>();
    expected.high = reader.value<std::uint64_t>();
    const auto stored = reader.take(fields.stored_size);
    if (reader.remaining() != 0)
        refuse_input(file, fmt::format("byte {}", reader.offset()),
                     fmt::format("{} bytes too many", reader.remaining()), "the end of the file");
    const Hash128 found = checksum(checked, stored);
    if (found != expected) refuse_input(file, "checksum", found.hex(), expected.hex());
    check_sizes(fields, file);
    return {std::move(fields.header), decompress(stored, fields.payload_size, file)};
}

}  // namespace

std::vector<std::byte> pack(const CookedAsset& asset) {
    ROWLAND_CHECK(!asset.header.type.empty() && asset.header.type.size() <= kMaximumTypeSize, "type name's length");
    if (asset.payload.size() > kMaximumPayloadSize)
        refuse_input({}, {}, fmt::format("a {} of {} bytes", asset.header.type, asset.payload.size()),
                     fmt::format("at most {} bytes", kMaximumPayloadSize), "make the source smaller");
    const std::vector<std::byte> stored = compress(asset.payload);

    ByteWriter writer;
    for (const char c : kMagic) writer.value(c);
    write_fields(writer, {asset.header, asset.payload.size(), stored.size()});
    const Hash128 sum = checksum(writer.data(), stored);
    writer.value(sum.low);
    writer.value(sum.high);
    std::vector<std::byte> bytes = writer.take();
    bytes.insert(bytes.end(), stored.begin(), stored.end());
    return bytes;
}

CookedAsset unpack(std::span<const std::byte> bytes, const std::string& file) {
    try {
        return parse(bytes, file);
    } catch (const Error& error) {
        ErrorInfo info = error.info();
        info.remedy = kRecook;
        throw Error(std::move(info));
    }
}

bool is_cooked(std::span<const std::byte> bytes) {
    return bytes.size() >= kMagic.size() && begins_like_magic(bytes);
}

CookedAsset load_any(const std::filesystem::path& path) {
    return unpack(read_file(path, ZSTD_compressBound(kMaximumPayloadSize) + kMaximumHeaderSize), path.string());
}

void check_type(const Header& header, const std::string& type, std::uint32_t type_version, const std::string& file) {
    if (header.type != type)
        refuse_input(file, "header", fmt::format("an asset of type \"{}\"", header.type), fmt::format("\"{}\"", type),
                     kRecook);
    check_version(type, header.type_version, type_version, file);
}

CookedAsset load(const std::filesystem::path& path, const std::string& type, std::uint32_t type_version) {
    CookedAsset asset = load_any(path);
    check_type(asset.header, type, type_version, path.string());
    return asset;
}

}  // namespace rowland::asset
