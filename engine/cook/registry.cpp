#include "engine/cook/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/text.h"

namespace rowland::cook {

namespace {

constexpr std::uint64_t kMaximumJsonBytes = std::uint64_t{16} << 20;

}  // namespace

std::optional<Hash128> hash_dependency(const std::filesystem::path& path) {
    std::error_code unknown;
    const bool missing = std::filesystem::status(path, unknown).type() == std::filesystem::file_type::not_found;
    return missing ? Hash128{} : hash_file(path);
}

void Context::depend_on(const std::filesystem::path& path) {
    if (std::find(dependencies_.begin(), dependencies_.end(), path) != dependencies_.end()) return;
    dependencies_.push_back(path);
    fingerprints_.push_back(hash_dependency(path));
}

Context Context::part() const {
    Context part;
    part.source_ = source_;
    part.dependencies_ = {dependencies_.front()};
    part.fingerprints_ = {fingerprints_.front()};
    return part;
}

void Context::depend_on_all_of(const Context& part) {
    for (std::size_t i = 0; i < part.dependencies_.size(); ++i) {
        const std::filesystem::path& path = part.dependencies_[i];
        const auto known = std::find(dependencies_.begin(), dependencies_.end(), path);
        if (known == dependencies_.end()) {
            dependencies_.push_back(path);
            fingerprints_.push_back(part.fingerprints_[i]);
        } else if (fingerprints_[static_cast<std::size_t>(known - dependencies_.begin())] != part.fingerprints_[i]) {
            fail_changed(path);
        }
    }
}

std::vector<std::byte> Context::read(const std::filesystem::path& path, std::uint64_t max_bytes,
                                     const std::string& remedy) {
    depend_on(path);
    std::vector<std::byte> bytes = read_file(path, max_bytes, remedy);
    // The bytes that are cooked must be those of the content hash, even if the file changes and is restored before the
    // hash is taken again.
    const auto index = std::find(dependencies_.begin(), dependencies_.end(), path) - dependencies_.begin();
    const std::optional<Hash128>& known = fingerprints_[static_cast<std::size_t>(index)];
    if (known && Hasher().bytes(bytes).digest() != *known) fail_changed(path);
    return bytes;
}

nlohmann::json Context::read_json(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read(path, kMaximumJsonBytes);
    return parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

nlohmann::ordered_json Context::read_ordered_json(const std::filesystem::path& path) {
    read_json(path);  // for its checks of depth, keys and numbers
    return nlohmann::ordered_json::parse(read(path, kMaximumJsonBytes));
}

void fail_changed(const std::filesystem::path& path) {
    fail_system(path.string(), "changed while it was being cooked", "cook again");
}

void Registry::add(AssetType type) {
    ROWLAND_CHECK(!type.name.empty() && find(type.name) == nullptr, "asset type names are unique: " + type.name);
    ROWLAND_CHECK(type.recognises && type.check, "recognises and checks its sources: " + type.name);
    ROWLAND_CHECK(!type.cook || type.describe, "describes what it cooks: " + type.name);
    types_.push_back(std::move(type));
}

std::vector<std::string> Registry::gltf_extension_names() const {
    std::vector<std::string> names;
    for (const GltfExtension& extension : gltf_extensions_) names.push_back(extension.name);
    return names;
}

const AssetType* Registry::recognise(const std::filesystem::path& source) const {
    std::optional<nlohmann::json> json;
    if (lower_case(source.extension().string()) == ".json")
        json = parse_json(read_text_file(source, kMaximumJsonBytes), source.string());

    const AssetType* claim = nullptr;
    for (const AssetType& type : types_) {
        if (!type.recognises(source, json ? &*json : nullptr)) continue;
        if (claim != nullptr) fail_type(source, fmt::format("claimed by {} and {}", claim->name, type.name));
        claim = &type;
    }
    return claim;
}

const AssetType& Registry::type_of_source(const std::filesystem::path& source) const {
    const AssetType* type = recognise(source);
    if (type == nullptr) fail_type(source, "a source of no known type");
    return *type;
}

void Registry::fail_type(const std::filesystem::path& source, std::string found) const {
    std::vector<std::string> names;
    for (const AssetType& type : types_) names.push_back(type.name);
    refuse_input(source.string(), {}, std::move(found), fmt::format("one of {}", fmt::join(names, ", ")));
}

const AssetType* Registry::find(const std::string& name) const {
    for (const AssetType& type : types_)
        if (type.name == name) return &type;
    return nullptr;
}

}  // namespace rowland::cook
