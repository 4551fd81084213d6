#include "engine/cook/check_file.h"

#include <fmt/format.h>

#include "engine/asset/container.h"
#include "engine/cook/source_file.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::cook {

namespace {

/// Long enough for any magic.
constexpr std::size_t kBeginning = 64;

bool is_cooked_file(const std::filesystem::path& path) {
    return asset::is_cooked(read_beginning(path, kBeginning));
}

struct DescribedAsset {
    asset::CookedAsset asset;
    std::string description;
};

DescribedAsset load_cooked(const Registry& registry, const std::filesystem::path& path) {
    DescribedAsset described;
    described.asset = asset::load_any(path);
    const asset::Header& header = described.asset.header;
    const AssetType* type = registry.find(header.type);
    if (type == nullptr || !type->describe)
        refuse_input(path.string(), "header", fmt::format("a cooked asset of the unknown type \"{}\"", header.type),
                     "a type this program knows");
    asset::check_type(header, type->name, type->version, path.string());
    described.description = type->describe(described.asset.payload, path.string());
    return described;
}

}  // namespace

std::string check_file(const Registry& registry, const std::filesystem::path& path) {
    return as_refusal_of(path, [&] {
        if (is_cooked_file(path)) return "cooked " + load_cooked(registry, path).asset.header.type;
        const AssetType& type = registry.type_of_source(path);
        Context context(path);
        type.check(context);
        return type.name + " source";
    });
}

std::string describe_file(const Registry& registry, const std::filesystem::path& path) {
    return as_refusal_of(path, [&] {
        if (is_cooked_file(path)) {
            const DescribedAsset described = load_cooked(registry, path);
            const asset::Header& header = described.asset.header;
            return fmt::format("type: {}\nversion: {}\ncontent hash: {}\npayload: {} bytes\n{}", header.type,
                               header.type_version, header.content_hash.hex(), described.asset.payload.size(),
                               described.description);
        }
        const AssetType& type = registry.type_of_source(path);
        if (type.describe_source) {
            Context context(path);
            return fmt::format("type: {} source\n{}", type.name, type.describe_source(context));
        }
        if (type.in_container || !type.describe)
            refuse_input(path.string(), {}, fmt::format("a {} source", type.name), "a cooked asset",
                         fmt::format("cook it first: rowland-cook cook {} -o OUTPUT", path.string()));
        const std::vector<std::byte> bytes = read_file(path, kMaximumSourceBytes);
        return fmt::format("type: {}\npayload: {} bytes\n{}", type.name, bytes.size(),
                           type.describe(bytes, path.string()));
    });
}

}  // namespace rowland::cook
