#include "editor/cooker/job_record.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

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
    try {
        const nlohmann::json json = parse_json(read_text_file(file, kMostRecordBytes), file.string());
        JobRecord record{.cooker = json.at("cooker"),
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

}  // namespace rowland::editor
