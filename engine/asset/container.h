#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/core/file.h"

namespace rowland::asset {

/// What a cooked file says of itself before its payload.
struct Header {
    std::string type;                ///< "probe", "material", ...
    std::uint32_t type_version = 0;  ///< version of the payload's layout
    Hash128 content_hash;            ///< over source, settings and tool version: equal hash, equal payload
};

struct CookedAsset {
    Header header;
    std::vector<std::byte> payload;
};

/// The bytes of a cooked file: magic, container version, header, payload (zstd) and its checksum. The same input gives
/// the same bytes, on every machine with the same release of zstd. Throws Error (input) if the payload is over 1 GiB.
std::vector<std::byte> pack(const CookedAsset& asset);

/// Inverse of pack() for bytes that may be hostile: the checksum is over all other bytes, and sizes are checked before
/// anything is allocated. Throws Error (input) naming `file`, the location and the command that recooks it.
CookedAsset unpack(std::span<const std::byte> bytes, const std::string& file);

/// True if the bytes begin with the container's magic.
bool is_cooked(std::span<const std::byte> bytes);

/// Reads a cooked file of any type. Throws Error as read_file() and unpack() do.
CookedAsset load_any(const std::filesystem::path& path);

/// Throws Error (input) unless `header` is of the given type and version; see load().
void check_type(const Header& header, const std::string& type, std::uint32_t type_version, const std::string& file);

/// Reads a cooked file of the given type and version. Throws Error as load_any() does, and Error (input) for another
/// type or version, naming the file, what was found, what was expected and the command that recooks it.
CookedAsset load(const std::filesystem::path& path, const std::string& type, std::uint32_t type_version);

}  // namespace rowland::asset
