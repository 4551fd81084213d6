#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>

#include "tests/benchmark/frame_variant.h"

namespace rowland::benchmark {

/// How often loops run whose length the shaders read from memory, by the GLSL expression of the length.
using LoopLengths = std::map<std::string, int>;

/// Those of the current draw, as the buffers bound now say.
LoopLengths loop_lengths(GLuint program);

/// The texts of a linked program as the driver got them, by stage: "vert", "frag" or "comp".
using ProgramTexts = std::map<std::string, std::string>;

/// Records the programs that are linked during its life, and the one that draws meshes. One at a time; its context is
/// current.
class ProgramLog {
 public:
    ProgramLog();
    ~ProgramLog();
    ProgramLog(const ProgramLog&) = delete;
    ProgramLog& operator=(const ProgramLog&) = delete;

    /// Each program once, however often it was linked.
    const std::vector<ProgramTexts>& programs() const { return programs_; }

    struct MeshDraw {
        std::size_t program;  ///< in programs()
        LoopLengths lengths;
    };
    /// The last draw of an indexed mesh.
    const std::optional<MeshDraw>& last_mesh() const { return last_mesh_; }

    /// The programs of draws without indices, each once: passes over the picture.
    const std::vector<std::size_t>& passes() const { return passes_; }

 private:
    struct Replaced;

    static void shader_source(GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths);
    static void attach_shader(GLuint program, GLuint shader);
    static void link_program(GLuint program);
    static void draw_arrays(GLenum mode, GLint first, GLsizei count, GLsizei instances);
    static void draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices);
    static void draw_instances(GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances);
    static void note_mesh();

    void record(GLuint program);
    /// In programs(); none if it was linked before the log began.
    std::optional<std::size_t> current() const;

    std::map<GLuint, std::string> shader_texts_;
    std::map<GLuint, ProgramTexts> attached_;
    std::map<GLuint, std::size_t> linked_;
    std::map<ProgramTexts, std::size_t> known_;
    std::vector<ProgramTexts> programs_;
    std::optional<MeshDraw> last_mesh_;
    std::vector<std::size_t> passes_;
    std::unique_ptr<Replaced> replaced_;
};

/// Draws each variant and writes the GLSL of all programs that were linked, N.vert with N.frag or N.comp, and
/// programs.json: "programs" (the files' names without extension), "frames" ("name", the "program" that draws its disc,
/// and "lengths", how often its loops run), each followed by the passes that its effect adds ("NAME/pass:1"). A context
/// must be current.
void write_programs(const std::filesystem::path& folder, const std::vector<FrameVariant>& variants, glm::ivec2 size,
                    bool software);

}  // namespace rowland::benchmark
