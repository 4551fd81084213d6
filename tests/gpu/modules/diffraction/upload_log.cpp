#include "tests/gpu/modules/diffraction/upload_log.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>

#include "engine/core/check.h"

namespace rowland::test {

namespace {

struct Uploads {
    std::size_t bytes = 0;
    std::vector<std::string> shaders;
};
Uploads* log = nullptr;

/// The driver's own function: epoxy's pointers are what is replaced.
template <typename F>
F driver(const char* name) {
    const auto function = reinterpret_cast<F>(eglGetProcAddress(name));
    ROWLAND_CHECK(function != nullptr, "a driver of OpenGL 4.5");
    return function;
}

std::size_t components(GLenum format) {
    switch (format) {
        case GL_RED:
            return 1;
        case GL_RG:
            return 2;
        case GL_RGB:
            return 3;
        case GL_RGBA:
            return 4;
        default:
            check_failed(__FILE__, __LINE__, "a pixel format that is counted");
    }
}

std::size_t texel_bytes(GLenum format, GLenum type) {
    switch (type) {
        case GL_UNSIGNED_BYTE:
            return components(format);
        case GL_UNSIGNED_SHORT:
        case GL_HALF_FLOAT:
            return 2 * components(format);
        case GL_FLOAT:
            return 4 * components(format);
        default:
            check_failed(__FILE__, __LINE__, "a pixel type that is counted");
    }
}

void count_texels(GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type) {
    log->bytes += static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(depth) *
                  texel_bytes(format, type);
}

void APIENTRY buffer_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags) {
    log->bytes += static_cast<std::size_t>(size);
    driver<PFNGLNAMEDBUFFERSTORAGEPROC>("glNamedBufferStorage")(buffer, size, data, flags);
}

void APIENTRY buffer_part(GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data) {
    log->bytes += static_cast<std::size_t>(size);
    driver<PFNGLNAMEDBUFFERSUBDATAPROC>("glNamedBufferSubData")(buffer, offset, size, data);
}

void APIENTRY line(GLuint texture, GLint level, GLint x, GLsizei width, GLenum format, GLenum type,
                   const void* texels) {
    count_texels(width, 1, 1, format, type);
    driver<PFNGLTEXTURESUBIMAGE1DPROC>("glTextureSubImage1D")(texture, level, x, width, format, type, texels);
}

void APIENTRY plane(GLuint texture, GLint level, GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                    GLenum type, const void* texels) {
    count_texels(width, height, 1, format, type);
    driver<PFNGLTEXTURESUBIMAGE2DPROC>("glTextureSubImage2D")(texture, level, x, y, width, height, format, type,
                                                              texels);
}

void APIENTRY volume(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height,
                     GLsizei depth, GLenum format, GLenum type, const void* texels) {
    count_texels(width, height, depth, format, type);
    driver<PFNGLTEXTURESUBIMAGE3DPROC>("glTextureSubImage3D")(texture, level, x, y, z, width, height, depth, format,
                                                              type, texels);
}

void APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    std::string whole;
    for (GLsizei i = 0; i < count; ++i)
        whole += lengths != nullptr && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i]))
                                                       : std::string(texts[i]);
    log->shaders.push_back(whole);
    driver<PFNGLSHADERSOURCEPROC>("glShaderSource")(shader, count, texts, lengths);
}

/// Exchanges each of epoxy's pointers for the one kept here: again, and all is as before.
void exchange_functions() {
    static PFNGLNAMEDBUFFERSTORAGEPROC kept_storage = buffer_storage;
    static PFNGLNAMEDBUFFERSUBDATAPROC kept_part = buffer_part;
    static PFNGLTEXTURESUBIMAGE1DPROC kept_line = line;
    static PFNGLTEXTURESUBIMAGE2DPROC kept_plane = plane;
    static PFNGLTEXTURESUBIMAGE3DPROC kept_volume = volume;
    static PFNGLSHADERSOURCEPROC kept_source = shader_source;
    std::swap(epoxy_glNamedBufferStorage, kept_storage);
    std::swap(epoxy_glNamedBufferSubData, kept_part);
    std::swap(epoxy_glTextureSubImage1D, kept_line);
    std::swap(epoxy_glTextureSubImage2D, kept_plane);
    std::swap(epoxy_glTextureSubImage3D, kept_volume);
    std::swap(epoxy_glShaderSource, kept_source);
}

}  // namespace

UploadLog::UploadLog() {
    ROWLAND_CHECK(log == nullptr, "one log at a time");
    log = new Uploads;
    exchange_functions();
}

UploadLog::~UploadLog() {
    exchange_functions();
    delete log;
    log = nullptr;
}

std::size_t UploadLog::bytes() const {
    return log->bytes;
}

const std::vector<std::string>& UploadLog::shaders() const {
    return log->shaders;
}

}  // namespace rowland::test
