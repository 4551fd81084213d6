#include "tests/gpu/call_counts.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

#include "engine/core/check.h"

namespace rowland::test {

namespace {

using Counts = CallCounts::Counts;

/// What the driver was told since counting began.
struct Told {
    Counts counts;
    std::map<std::string, std::string> values;  ///< of each thing that is set
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

/// Stands in place of one of epoxy's pointers.
template <auto Pointer, typename Note>
class Hook;
template <typename R, typename... Args, R (**Pointer)(Args...), typename Note>
class Hook<Pointer, Note> {
 public:
    static void exchange(const char* name) {
        name_ = name;
        driver_ = reinterpret_cast<R (*)(Args...)>(eglGetProcAddress(name));
        ROWLAND_CHECK(driver_ != nullptr, "a driver of OpenGL 4.5");
        std::swap(*Pointer, kept_);
    }

 private:
    static R call(Args... args) {
        Note::note(name_, args...);
        return driver_(args...);
    }
    static inline const char* name_ = nullptr;
    static inline R (*driver_)(Args...) = nullptr;
    static inline R (*kept_)(Args...) = call;
};

/// Exchanges epoxy's pointers for those kept here: again, and all is as before.
void exchange_pointers() {
#define ROWLAND_HOOK(function, ...) Hook<&epoxy_##function, __VA_ARGS__>::exchange(#function)
    ROWLAND_HOOK(glDrawElements, Count<&Counts::draws>);
    ROWLAND_HOOK(glDrawArraysInstanced, Count<&Counts::draws>);
    ROWLAND_HOOK(glFinish, Count<&Counts::waits>);
    ROWLAND_HOOK(glClientWaitSync, Count<&Counts::waits>);
    ROWLAND_HOOK(glReadPixels, Count<&Counts::waits>);
    ROWLAND_HOOK(glGetTextureSubImage, Count<&Counts::waits>);
    ROWLAND_HOOK(glGetNamedBufferSubData, Count<&Counts::waits>);
    ROWLAND_HOOK(glGetQueryObjectui64v, Count<&Counts::waits>);
    ROWLAND_HOOK(glCreateBuffers, Count<&Counts::made>);
    ROWLAND_HOOK(glCreateTextures, Count<&Counts::made>);
    ROWLAND_HOOK(glCreateFramebuffers, Count<&Counts::made>);
    ROWLAND_HOOK(glCreateRenderbuffers, Count<&Counts::made>);
    ROWLAND_HOOK(glCreateVertexArrays, Count<&Counts::made>);
    ROWLAND_HOOK(glCompileShader, Count<&Counts::compiled>);
    ROWLAND_HOOK(glLinkProgram, Count<&Counts::compiled>);
    ROWLAND_HOOK(glNamedBufferSubData, Count<&Counts::copied>);
    ROWLAND_HOOK(glTextureSubImage2D, Count<&Counts::copied>);
    ROWLAND_HOOK(glTextureSubImage3D, Count<&Counts::copied>);
    ROWLAND_HOOK(glUseProgram, Set<0>);
    ROWLAND_HOOK(glBindVertexArray, Set<0>);
    ROWLAND_HOOK(glViewport, Set<0>);
    ROWLAND_HOOK(glScissor, Set<0>);
    ROWLAND_HOOK(glDepthMask, Set<0>);
    ROWLAND_HOOK(glDepthFunc, Set<0>);
    ROWLAND_HOOK(glCullFace, Set<0>);
    ROWLAND_HOOK(glFrontFace, Set<0>);
    ROWLAND_HOOK(glBlendFuncSeparate, Set<0>);
    ROWLAND_HOOK(glPolygonOffset, Set<0>);
    ROWLAND_HOOK(glColorMask, Set<0>);
    ROWLAND_HOOK(glPixelStorei, Set<1>);
    ROWLAND_HOOK(glBindTextureUnit, Set<1>);
    ROWLAND_HOOK(glBindFramebuffer, Set<1>);
    ROWLAND_HOOK(glNamedFramebufferReadBuffer, Set<1>);
    ROWLAND_HOOK(glNamedFramebufferDrawBuffer, Set<1>);
    ROWLAND_HOOK(glBindBufferBase, Set<2>);
    ROWLAND_HOOK(glBindBufferRange, Set<2>);
    ROWLAND_HOOK(glEnable, Enable);
    ROWLAND_HOOK(glDisable, Enable);
    ROWLAND_HOOK(glProgramUniform1i, Set<2>);
    ROWLAND_HOOK(glProgramUniform1f, Set<2>);
    ROWLAND_HOOK(glProgramUniform1iv, Uniform<1>);
    ROWLAND_HOOK(glProgramUniform1fv, Uniform<1>);
    ROWLAND_HOOK(glProgramUniform2iv, Uniform<2>);
    ROWLAND_HOOK(glProgramUniform2fv, Uniform<2>);
    ROWLAND_HOOK(glProgramUniform3fv, Uniform<3>);
    ROWLAND_HOOK(glProgramUniform4fv, Uniform<4>);
    ROWLAND_HOOK(glProgramUniformMatrix3fv, Uniform<9>);
    ROWLAND_HOOK(glProgramUniformMatrix4fv, Uniform<16>);
#undef ROWLAND_HOOK
}

}  // namespace

CallCounts::CallCounts() {
    ROWLAND_CHECK(told == nullptr, "one at a time");
    told = new Told;
    exchange_pointers();
}

CallCounts::~CallCounts() {
    exchange_pointers();
    delete told;
    told = nullptr;
}

CallCounts::Counts CallCounts::take() {
    return std::exchange(told->counts, {});
}

}  // namespace rowland::test
