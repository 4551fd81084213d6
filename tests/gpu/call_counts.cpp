#include "tests/gpu/call_counts.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

using Counts = CallCounts::Counts;

/// What the driver was told since counting began.
struct Told {
    Counts counts;
    std::map<std::string, std::string> values;  ///< of each thing that is set
    std::vector<std::shared_ptr<void>> noted;
};
Told* told = nullptr;

template <typename T>
void append(std::string& bytes, const T* values, std::size_t count = 1) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void note_set(const std::string& name, const std::string& what, const std::string& value) {
    ++told->counts.set;
    const auto [known, is_new] = told->values.try_emplace(what, value);
    if (!is_new && known->second == value) {
        ++told->counts.redundant;
        ++told->counts.which[name + " again"];
    }
    known->second = value;
}

/// Counts a call in one of the members.
template <int Counts::*Member>
struct Count {
    template <typename... Args>
    static void note(const std::string& name, const Args&...) {
        ++(told->counts.*Member);
        if (Member != &Counts::draws) ++told->counts.which[name];
    }
};

/// A call that sets what its first arguments name to what the others say.
template <int Names>
struct Set {
    template <typename... Args>
    static void note(const std::string& name, const Args&... args) {
        std::string what = name;
        std::string value;
        int index = 0;
        (append(index++ < Names ? what : value, &args), ...);
        note_set(name, what, value);
    }
};

struct Enable {
    static void note(const std::string& name, GLenum capability) { note_set(name, std::to_string(capability), name); }
};

/// A uniform of so many components, given by a pointer.
template <std::size_t Components>
struct Uniform {
    template <typename T>
    static void note(const std::string& name, GLuint program, GLint location, GLsizei count, const T* values) {
        std::string what = "uniform";
        std::string value;
        append(what, &program);
        append(what, &location);
        append(value, values, Components * static_cast<std::size_t>(count));
        note_set(name, what, value);
    }
    static void note(const std::string& name, GLuint program, GLint location, GLsizei count, GLboolean,
                     const GLfloat* values) {
        note(name, program, location, count, values);
    }
};

/// Notes each call of a function, then calls the driver's.
template <auto Pointer, typename Note>
class Noted;
template <typename R, typename... Args, R (**Pointer)(Args...), typename Note>
class Noted<Pointer, Note> {
 public:
    explicit Noted(const char* name) : replaced_(name, call) { name_ = name; }

 private:
    static R call(Args... args) {
        Note::note(name_, args...);
        return ReplacedFunction<Pointer>::driver(args...);
    }
    static inline const char* name_ = nullptr;
    ReplacedFunction<Pointer> replaced_;
};

/// The functions that are noted while the result lives.
std::vector<std::shared_ptr<void>> note_calls() {
    std::vector<std::shared_ptr<void>> noted;
#define ROWLAND_NOTE(function, ...) noted.push_back(std::make_shared<Noted<&epoxy_##function, __VA_ARGS__>>(#function))
    ROWLAND_NOTE(glDrawElements, Count<&Counts::draws>);
    ROWLAND_NOTE(glDrawElementsInstanced, Count<&Counts::draws>);
    ROWLAND_NOTE(glDrawArraysInstanced, Count<&Counts::draws>);
    ROWLAND_NOTE(glFinish, Count<&Counts::waits>);
    ROWLAND_NOTE(glClientWaitSync, Count<&Counts::waits>);
    ROWLAND_NOTE(glReadPixels, Count<&Counts::waits>);
    ROWLAND_NOTE(glGetTextureSubImage, Count<&Counts::waits>);
    ROWLAND_NOTE(glGetNamedBufferSubData, Count<&Counts::waits>);
    ROWLAND_NOTE(glGetQueryObjectui64v, Count<&Counts::waits>);
    ROWLAND_NOTE(glCreateBuffers, Count<&Counts::made>);
    ROWLAND_NOTE(glCreateTextures, Count<&Counts::made>);
    ROWLAND_NOTE(glCreateFramebuffers, Count<&Counts::made>);
    ROWLAND_NOTE(glCreateRenderbuffers, Count<&Counts::made>);
    ROWLAND_NOTE(glCreateVertexArrays, Count<&Counts::made>);
    ROWLAND_NOTE(glCompileShader, Count<&Counts::compiled>);
    ROWLAND_NOTE(glLinkProgram, Count<&Counts::compiled>);
    ROWLAND_NOTE(glNamedBufferSubData, Count<&Counts::copied>);
    ROWLAND_NOTE(glCopyNamedBufferSubData, Count<&Counts::copied>);
    ROWLAND_NOTE(glTextureSubImage2D, Count<&Counts::copied>);
    ROWLAND_NOTE(glTextureSubImage3D, Count<&Counts::copied>);
    ROWLAND_NOTE(glUseProgram, Set<0>);
    ROWLAND_NOTE(glBindVertexArray, Set<0>);
    ROWLAND_NOTE(glViewport, Set<0>);
    ROWLAND_NOTE(glScissor, Set<0>);
    ROWLAND_NOTE(glDepthMask, Set<0>);
    ROWLAND_NOTE(glDepthFunc, Set<0>);
    ROWLAND_NOTE(glCullFace, Set<0>);
    ROWLAND_NOTE(glFrontFace, Set<0>);
    ROWLAND_NOTE(glBlendFuncSeparate, Set<0>);
    ROWLAND_NOTE(glPolygonOffset, Set<0>);
    ROWLAND_NOTE(glColorMask, Set<0>);
    ROWLAND_NOTE(glPixelStorei, Set<1>);
    ROWLAND_NOTE(glBindTextureUnit, Set<1>);
    ROWLAND_NOTE(glBindFramebuffer, Set<1>);
    ROWLAND_NOTE(glNamedFramebufferReadBuffer, Set<1>);
    ROWLAND_NOTE(glNamedFramebufferDrawBuffer, Set<1>);
    ROWLAND_NOTE(glBindBufferBase, Set<2>);
    ROWLAND_NOTE(glBindBufferRange, Set<2>);
    ROWLAND_NOTE(glEnable, Enable);
    ROWLAND_NOTE(glDisable, Enable);
    ROWLAND_NOTE(glProgramUniform1i, Set<2>);
    ROWLAND_NOTE(glProgramUniform1f, Set<2>);
    ROWLAND_NOTE(glProgramUniform1iv, Uniform<1>);
    ROWLAND_NOTE(glProgramUniform1fv, Uniform<1>);
    ROWLAND_NOTE(glProgramUniform2iv, Uniform<2>);
    ROWLAND_NOTE(glProgramUniform2fv, Uniform<2>);
    ROWLAND_NOTE(glProgramUniform3fv, Uniform<3>);
    ROWLAND_NOTE(glProgramUniform4fv, Uniform<4>);
    ROWLAND_NOTE(glProgramUniformMatrix3fv, Uniform<9>);
    ROWLAND_NOTE(glProgramUniformMatrix4fv, Uniform<16>);
#undef ROWLAND_NOTE
    return noted;
}

}  // namespace

CallCounts::CallCounts() {
    ROWLAND_CHECK(told == nullptr, "one at a time");
    told = new Told{.counts = {}, .values = {}, .noted = note_calls()};
}

CallCounts::~CallCounts() {
    delete told;
    told = nullptr;
}

CallCounts::Counts CallCounts::take() {
    return std::exchange(told->counts, {});
}

}  // namespace rowland::test
