#include "tests/benchmark/program_folder.h"

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/core/check.h"
#include "engine/core/file.h"
#include "engine/core/progress.h"
#include "tests/benchmark/frame_stage.h"
#include "tests/benchmark/program_log.h"

namespace rowland::benchmark {

void write_programs(const std::filesystem::path& folder, const std::vector<FrameVariant>& variants, glm::ivec2 size,
                    bool software) {
    const ProgramLog log;
    FrameStage stage(size);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    Progress progress("programs", variants.size());
    const auto add = [&](const std::string& name, std::size_t program, const LoopLengths& lengths) {
        frames.push_back({{"name", name}, {"program", std::to_string(program)}, {"lengths", lengths}});
    };
    for (const FrameVariant& variant : variants) {
        const std::size_t known_passes = log.passes().size();
        FrameScene(variant, stage, software).settle();
        ROWLAND_CHECK(log.last_mesh().has_value(), "a frame without its disc");
        add(variant.name, log.last_mesh()->program, log.last_mesh()->lengths);
        for (std::size_t i = known_passes; i < log.passes().size() && variant.effect != Effect::None; ++i)
            add(fmt::format("{}/pass:{}", variant.name, i - known_passes + 1), log.passes()[i], {});
        progress.advance();
    }
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const ProgramTexts& program : log.programs()) {
        names.push_back(std::to_string(names.size()));
        for (const auto& [stage_name, text] : program)
            write_file_atomic(folder / (names.back().get<std::string>() + "." + stage_name), text);
    }
    const nlohmann::ordered_json json = {{"programs", names}, {"frames", frames}};
    write_file_atomic(folder / "programs.json", json.dump(2) + "\n");
}

}  // namespace rowland::benchmark
