#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"

namespace rowland::render {

/// Programs by description, each compiled on first use.
class ProgramCache {
 public:
    gpu::ShaderLibrary& library() { return library_; }
    const gpu::ShaderLibrary& library() const { return library_; }

    /// Valid until reload(). Throws Error (system) if it does not compile.
    const gpu::Program& get(const gpu::ProgramDesc& desc);
    /// Recompiles all, from `source_tree` where it has their files. If one does not compile, all stay as they were and
    /// its Error (system) is thrown.
    void reload(const std::filesystem::path& source_tree);
    std::size_t size() const { return programs_.size(); }

 private:
    struct Compiled {
        gpu::ProgramDesc desc;
        gpu::Program program;
    };

    gpu::ShaderLibrary library_;
    std::map<std::string, Compiled> programs_;
};

}  // namespace rowland::render
