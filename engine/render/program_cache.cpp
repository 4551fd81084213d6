#include "engine/render/program_cache.h"

#include <utility>

namespace rowland::render {

namespace {

std::string key_of(const gpu::ProgramDesc& desc) {
    std::string key = desc.vertex + '\n' + desc.fragment;
    for (const auto& [name, value] : desc.defines) key.append("\n").append(name).append("=").append(value);
    return key;
}

}  // namespace

const gpu::Program& ProgramCache::get(const gpu::ProgramDesc& desc) {
    std::string key = key_of(desc);
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second.program;
    return programs_.emplace(std::move(key), Compiled{desc, gpu::Program(library_, desc)}).first->second.program;
}

void ProgramCache::reload(const std::filesystem::path& source_tree) {
    gpu::ShaderLibrary library = library_;
    library.set_source_folder(source_tree);
    std::map<std::string, Compiled> programs;
    for (const auto& [key, compiled] : programs_)
        programs.emplace(key, Compiled{compiled.desc, gpu::Program(library, compiled.desc)});
    library_ = std::move(library);
    programs_ = std::move(programs);
}

}  // namespace rowland::render
