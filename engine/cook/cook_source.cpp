#include "engine/cook/cook_source.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"

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
        const std::optional<Hash128> now = hash_dependency(path);
        if (now != context.fingerprints()[i]) fail_changed(path);
        if (!now)
            refuse_input(path.string(), {}, "an unreadable file",
                         fmt::format("a file of at most {} bytes", kMaximumHashedBytes));
        hashes.push_back(*now);
    }
    return content_hash(type, hashes);
}

}  // namespace

std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& dependencies) {
    std::string text = escaped(output) + ":";
    for (const std::filesystem::path& dependency : dependencies)
        text += " \\\n  " + escaped(std::filesystem::absolute(dependency).generic_string());
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

BakedAsset bake_source(const Registry& registry, const std::filesystem::path& source,
                       const std::filesystem::path& parts_folder) {
    read_beginning(source, 1);  // throws unless it is a readable file
    const AssetType& type =
        as_refusal_of(source, [&]() -> const AssetType& { return registry.type_of_source(source); });
    if (!type.cook)
        refuse_input(source.string(), {}, fmt::format("a {}, which is only checked, never cooked", type.name),
                     "a source that is cooked");
    Context context(source, parts_folder);
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
    BakedAsset baked = bake_source(registry, source, settings.parts_folder);
    check_outputs(baked.dependencies, outputs);  // what the source names is known only now
    // Made before anything is written, since it may refuse a name.
    std::string depfile;
    if (settings.depfile) {
        // A build system would rebuild an output each time if one of its dependencies does not exist.
        std::vector<std::filesystem::path> present = baked.dependencies;
        std::erase_if(present, [](const auto& path) { return !std::filesystem::exists(path); });
        depfile = depfile_text(output, present);
    }

    write_file_atomic(output, baked.in_container ? asset::pack(baked.asset) : baked.asset.payload);
    if (settings.depfile) write_file_atomic(*settings.depfile, depfile);
    return baked;
}

namespace {

constexpr std::uint64_t kMostRecordBytes = std::uint64_t{16} << 20;

/// The paths relative to the source's folder.
std::vector<std::filesystem::path> beside(const std::filesystem::path& source,
                                          std::span<const std::filesystem::path> files) {
    std::vector<std::filesystem::path> names;
    for (const std::filesystem::path& file : files) names.push_back(file.lexically_proximate(source.parent_path()));
    return names;
}

/// The files of a record beside the source, without the source.
std::vector<std::filesystem::path> named_files(const CookRecord& record, const std::filesystem::path& source) {
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 1; i < record.dependencies.size(); ++i)
        files.push_back(source.parent_path() / record.dependencies[i]);
    return files;
}

/// Present hashes of files; nullopt if one cannot be read.
std::optional<std::vector<Hash128>> hashes_of(std::span<const std::filesystem::path> files) {
    std::vector<Hash128> hashes;
    for (const std::filesystem::path& file : files) {
        const std::optional<Hash128> hash = hash_dependency(file);
        if (!hash) return std::nullopt;
        hashes.push_back(*hash);
    }
    return hashes;
}

}  // namespace

void write_cook_record(const std::filesystem::path& file, const CookRecord& record) {
    nlohmann::ordered_json json = {{"cooker", record.cooker},
                                   {"content_hash", record.content_hash},
                                   {"output_hash", record.output_hash},
                                   {"dependencies", nlohmann::ordered_json::array()}};
    for (const std::filesystem::path& path : record.dependencies) json["dependencies"].push_back(path.generic_string());
    write_file_atomic(file, json.dump() + "\n");
}

std::optional<CookRecord> read_cook_record(const std::filesystem::path& file) {
    try {
        const nlohmann::json json = parse_json(read_text_file(file, kMostRecordBytes), file.string());
        CookRecord record{.cooker = json.at("cooker"),
                          .dependencies = {},
                          .content_hash = json.at("content_hash"),
                          .output_hash = json.at("output_hash")};
        for (const nlohmann::json& path : json.at("dependencies"))
            record.dependencies.emplace_back(path.get<std::string>());
        return record;
    } catch (const std::runtime_error&) {         // no such file
    } catch (const nlohmann::json::exception&) {  // no record
    }
    return std::nullopt;
}

namespace {

/// The parts of one key in a folder. Files are those that a part was made from, without the source: what the part takes
/// from that is in the key.
class KeptPart {
 public:
    KeptPart(const std::filesystem::path& folder, const std::string& key)
        : folder_(folder), key_(key), record_file_(folder / (hash_of({}).hex() + ".json")) {}

    /// The part, if its files have the content that it was made from, which `context` depends on then.
    std::optional<std::vector<std::byte>> find(Context& context) const {
        const std::optional<CookRecord> record = read_cook_record(record_file_);
        if (!record) return std::nullopt;
        const std::vector<std::filesystem::path> files = named_files(*record, context.source());
        const auto hashes = hashes_of(files);
        if (!hashes || hash_of(*hashes).hex() != record->content_hash) return std::nullopt;
        const std::filesystem::path file = file_of(record->content_hash);
        if (!std::filesystem::exists(file)) return std::nullopt;
        std::vector<std::byte> bytes = read_file(file, kMaximumHashedBytes);
        if (Hasher().bytes(bytes).digest().hex() != record->output_hash) return std::nullopt;
        for (const std::filesystem::path& named : files) context.depend_on(named);
        return bytes;
    }

    /// Does nothing if a file could not be read.
    void write(const Context& part, std::span<const std::byte> bytes) const {
        std::vector<Hash128> hashes;
        for (const std::optional<Hash128>& hash : std::span(part.fingerprints()).subspan(1)) {
            if (!hash) return;
            hashes.push_back(*hash);
        }
        const CookRecord record{.cooker = {},
                                .dependencies = beside(part.source(), part.dependencies()),
                                .content_hash = hash_of(hashes).hex(),
                                .output_hash = Hasher().bytes(bytes).digest().hex()};
        write_file_atomic(file_of(record.content_hash), bytes);
        write_cook_record(record_file_, record);
    }

 private:
    Hash128 hash_of(std::span<const Hash128> files) const {
        Hasher hasher;
        hasher.text(tool_version()).text(key_);
        for (const Hash128& file : files) hasher.text(file.hex());
        return hasher.digest();
    }
    std::filesystem::path file_of(const std::string& content_hash) const { return folder_ / (content_hash + ".part"); }

    const std::filesystem::path& folder_;
    const std::string& key_;
    std::filesystem::path record_file_;
};

}  // namespace

std::vector<std::byte> cook_part(Context& context, const std::string& key,
                                 const std::function<std::vector<std::byte>(Context&)>& make) {
    if (context.parts_folder().empty()) return make(context);
    const KeptPart kept(context.parts_folder(), key);
    if (std::optional<std::vector<std::byte>> bytes = kept.find(context)) return std::move(*bytes);
    Context part = context.part();
    std::vector<std::byte> bytes;
    try {
        bytes = make(part);
    } catch (...) {
        context.depend_on_all_of(part);  // also a file that is missing
        throw;
    }
    context.depend_on_all_of(part);
    kept.write(part, bytes);
    return bytes;
}

std::filesystem::path parts_folder(const std::filesystem::path& cache_folder) {
    return cache_folder / "parts";
}

std::filesystem::path cook_once(const Registry& registry, const std::filesystem::path& source,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files) {
    read_files.push_back(source);
    const std::optional<Hash128> source_hash = hash_file(source);
    const AssetType* type = source_hash ? registry.recognise(source) : nullptr;
    if (type == nullptr || !type->cook) {
        bake_source(registry, source);  // throws: says why it cannot be cooked
        refuse_input(source.string(), "", "a file that changed while it was read", "a source", "cook it again");
    }
    const auto output_of = [&](const std::string& content) { return cache_folder / (content + type->extension); };
    const std::filesystem::path record_file = cache_folder / (source_hash->hex() + ".json");
    if (const std::optional<CookRecord> record = read_cook_record(record_file)) {
        std::vector<std::filesystem::path> files = named_files(*record, source);
        files.insert(files.begin(), source);
        const auto hashes = hashes_of(files);
        if (hashes && content_hash(*type, *hashes).hex() == record->content_hash &&
            std::filesystem::exists(output_of(record->content_hash))) {
            read_files = std::move(files);
            return output_of(record->content_hash);
        }
    }
    log_info("cooking {}", source.string());
    BakedAsset baked = bake_source(registry, source, parts_folder(cache_folder));
    const CookRecord record{.cooker = {},
                            .dependencies = beside(source, baked.dependencies),
                            .content_hash = baked.asset.header.content_hash.hex(),
                            .output_hash = {}};
    std::filesystem::path output = output_of(record.content_hash);
    write_file_atomic(output, asset::pack(baked.asset));
    write_cook_record(record_file, record);
    read_files = std::move(baked.dependencies);
    return output;
}

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
        const std::vector<std::byte> bytes = read_file(path, kMaximumHashedBytes);
        return fmt::format("type: {}\npayload: {} bytes\n{}", type.name, bytes.size(),
                           type.describe(bytes, path.string()));
    });
}

}  // namespace rowland::cook
