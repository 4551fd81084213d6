#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::gpu {

/// One message of a GLSL compiler, mapped to its source file.
struct CompileMessage {
    std::string file;  ///< empty if the driver named no position
    std::size_t line = 0;
    std::string text;
};

/// Splits a driver's log into messages, errors first. Lines are numbered as in ShaderText, `files` are its files. Reads
/// the positions of Mesa "0:12(5): error: …", NVIDIA "0(12) : error …" and others "ERROR: 0:12: …"; any other line
/// becomes a message without one.
std::vector<CompileMessage> parse_compile_log(std::string_view log, std::span<const std::string> files);

}  // namespace rowland::gpu
