#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/platform/gl_context.h"

namespace rowland::benchmark {

/// One variant's result.
struct FrameResult {
    std::string name;
    std::string baseline;
    double minimum_ms = 0.0;  ///< least time until the picture was done
    double median_ms = 0.0;
    double work_ms = 0.0;        ///< least time of the GPU, or of the processor where that draws
    double mean_radiance = 0.0;  ///< of the picture
};

/// All results of a run.
struct FrameReport {
    std::string processor;
    unsigned threads = 0;
    std::string vendor;
    std::string renderer;  ///< GL_RENDERER
    std::string version;   ///< GL_VERSION
    bool software = true;  ///< the processor draws
    glm::ivec2 size{0};
    int rounds = 0;
    double coverage = 0.0;  ///< fraction of the picture that shows the disc
    std::vector<FrameResult> results;

    /// A result's least time over its baseline's, and its work over the baseline's.
    double ratio(const FrameResult& result) const;
    double work_ratio(const FrameResult& result) const;
};

/// Describes machine and driver of the current context.
FrameReport describe_machine(const platform::HeadlessContext& context);

/// Aligned columns.
std::string to_text(const FrameReport& report);
std::string to_json(const FrameReport& report);

/// GL_RENDERER as part of a file's name: lower case, with dashes in place of other characters than letters and digits.
std::string file_name_of(const std::string& renderer);

}  // namespace rowland::benchmark
