#include "editor/cooker/job_record.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"

namespace rowland::editor {

namespace {

constexpr std::uint64_t kMostRecordBytes = std::uint64_t{16} << 20;

}  // namespace

void write_job_record(const std::filesystem::path& file, const JobRecord& record) {
    nlohmann::ordered_json json = {{"cooker", record.cooker},
                                   {"content_hash", record.content_hash},
                                   {"output_hash", record.output_hash},
                                   {"dependencies", nlohmann::ordered_json::array()}};
    for (const std::filesystem::path& path : record.dependencies) json["dependencies"].push_back(path.string());
    write_file_atomic(file, json.dump() + "\n");
}

std::optional<JobRecord> read_job_record(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
        const nlohmann::json json = parse_json(read_text_file(file, kMostRecordBytes), file.string());
        JsonReader reader(json, file.string());
        JobRecord record{.cooker = reader.text("cooker"),
                         .dependencies = {},
                         .content_hash = reader.text("content_hash"),
                         .output_hash = reader.text("output_hash")};
        for (const nlohmann::json& path : reader.raw("dependencies"))
            record.dependencies.emplace_back(path.get<std::string>());
        return record;
    } catch (const Error&) {
        return std::nullopt;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace rowland::editor
