#include "engine/cook/cook_source.h"

#include <fmt/format.h>

#include <atomic>

#include "engine/cook/source_file.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::cook {

namespace {

std::atomic<std::uint64_t> baked_sources{0};

/// As gcc writes names: spaces and # behind a backslash, backslashes before them doubled, $ doubled.
std::string escaped(const std::filesystem::path& path) {
    std::string text;
    std::size_t backslashes = 0;
    for (const char c : path.string()) {
        if (c == '\n' || c == '\r' || c == '\0')
            refuse_input(path.string(), "name", "a line break", "a name that a dependency file can hold",
                         "rename the file");
        if (c == ' ' || c == '\t') text.append(backslashes, '\\');
        if (c == ' ' || c == '\t' || c == '#') text += '\\';
        if (c == '$') text += '$';
        backslashes = c == '\\' ? backslashes + 1 : 0;
        text += c;
    }
    return text;
}

/// Throws if a file has changed since the bake first read it.
Hash128 content_hash(const Context& context, const AssetType& type) {
    std::vector<Hash128> hashes;
    for (std::size_t i = 0; i < context.dependencies().size(); ++i) {
        const std::filesystem::path& path = context.dependencies()[i];
        const std::optional<Hash128> now = hash_file(path);
        if (now != context.fingerprints()[i]) fail_changed(path);
        if (!now)
            refuse_input(path.string(), {}, "an unreadable file",
                         fmt::format("a file of at most {} bytes", kMaximumSourceBytes));
        hashes.push_back(*now);
    }
    return content_hash(type, hashes);
}

}  // namespace

std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& dependencies) {
    std::string text = escaped(output) + ":";
    for (const std::filesystem::path& dependency : dependencies)
        text += " \\\n  " + escaped(std::filesystem::absolute(dependency));
    return text + "\n";
}

std::string_view tool_version() {
    return ROWLAND_VERSION;
}

std::uint64_t sources_baked() {
    return baked_sources;
}

Hash128 content_hash(const AssetType& type, std::span<const Hash128> dependencies) {
    Hasher hasher;
    hasher.text(tool_version()).text(type.name).text(std::to_string(type.version));
    for (const Hash128& dependency : dependencies) hasher.text(dependency.hex());
    return hasher.digest();
}

BakedAsset bake_source(const Registry& registry, const std::filesystem::path& source) {
    read_beginning(source, 1);  // nothing but a file is given to the types
    const AssetType& type =
        as_refusal_of(source, [&]() -> const AssetType& { return registry.type_of_source(source); });
    if (!type.cook)
        refuse_input(source.string(), {}, fmt::format("a {}, which is only checked, never cooked", type.name),
                     "a source that is cooked");
    Context context(source);
    ++baked_sources;
    BakedAsset baked;
    baked.asset.payload = as_refusal_of(source, [&] { return type.cook(context); });
    baked.asset.header = {type.name, type.version, content_hash(context, type)};
    baked.in_container = type.in_container;
    baked.dependencies = context.dependencies();
    return baked;
}

BakedAsset cook_source(const Registry& registry, const std::filesystem::path& source,
                       const std::filesystem::path& output, const CookSettings& settings) {
    std::vector<Output> outputs = {{"--output", output}};
    if (settings.depfile) outputs.push_back({"--depfile", *settings.depfile});
    check_outputs({&source, 1}, outputs);
    BakedAsset baked = bake_source(registry, source);
    check_outputs(baked.dependencies, outputs);  // what the source names is known only now
    // Made before anything is written, since it may refuse a name.
    const std::string depfile = settings.depfile ? depfile_text(output, baked.dependencies) : std::string();

    write_file_atomic(output, baked.in_container ? asset::pack(baked.asset) : baked.asset.payload);
    if (settings.depfile) write_file_atomic(*settings.depfile, depfile);
    return baked;
}

}  // namespace rowland::cook
