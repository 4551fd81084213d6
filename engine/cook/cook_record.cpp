#include "engine/cook/cook_record.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/cook/source_file.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"

namespace rowland::cook {

namespace {

constexpr std::uint64_t kMostRecordBytes = std::uint64_t{16} << 20;

/// The recorded dependencies of a source beside it, with their content as recorded; nullopt: something has changed.
std::optional<std::vector<std::filesystem::path>> unchanged(const CookRecord& record, const AssetType& type,
                                                            const std::filesystem::path& source) {
    std::vector<std::filesystem::path> files{source};
    for (std::size_t i = 1; i < record.dependencies.size(); ++i)
        files.push_back(source.parent_path() / record.dependencies[i]);
    std::vector<Hash128> hashes;
    for (const std::filesystem::path& file : files) {
        const std::optional<Hash128> hash = hash_file(file);
        if (!hash) return std::nullopt;
        hashes.push_back(*hash);
    }
    if (content_hash(type, hashes).hex() != record.content_hash) return std::nullopt;
    return files;
}

}  // namespace

void write_cook_record(const std::filesystem::path& file, const CookRecord& record) {
    nlohmann::ordered_json json = {{"cooker", record.cooker},
                                   {"content_hash", record.content_hash},
                                   {"output_hash", record.output_hash},
                                   {"dependencies", nlohmann::ordered_json::array()}};
    for (const std::filesystem::path& path : record.dependencies) json["dependencies"].push_back(path.string());
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

std::filesystem::path cook_once(const Registry& registry, const std::filesystem::path& source,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files) {
    read_files.push_back(source);
    const std::optional<Hash128> source_hash = hash_file(source);
    const AssetType* type = source_hash ? registry.recognise(source) : nullptr;
    if (type == nullptr || !type->cook) bake_source(registry, source);  // says why it cannot be cooked
    const auto output_of = [&](const std::string& content) { return cache_folder / (content + type->extension); };
    const std::filesystem::path record_file = cache_folder / (source_hash->hex() + ".json");
    if (const std::optional<CookRecord> record = read_cook_record(record_file))
        if (auto files = unchanged(*record, *type, source);
            files && std::filesystem::exists(output_of(record->content_hash))) {
            read_files = std::move(*files);
            return output_of(record->content_hash);
        }
    log_info("cooking {}", source.string());
    BakedAsset baked = bake_source(registry, source);
    CookRecord record{
        .cooker = {}, .dependencies = {}, .content_hash = baked.asset.header.content_hash.hex(), .output_hash = {}};
    for (const std::filesystem::path& path : baked.dependencies)
        record.dependencies.push_back(path.lexically_proximate(source.parent_path()));
    const std::filesystem::path output = output_of(record.content_hash);
    write_file_atomic(output, asset::pack(baked.asset));
    write_cook_record(record_file, record);
    read_files = std::move(baked.dependencies);
    return output;
}

}  // namespace rowland::cook
