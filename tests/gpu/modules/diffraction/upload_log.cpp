#include "tests/gpu/modules/diffraction/upload_log.h"

#include <epoxy/gl.h>

#include <optional>

#include "engine/core/check.h"
#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

struct Uploads {
    std::size_t bytes = 0;
    std::vector<std::string> shaders;
};
Uploads* log = nullptr;

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
    ReplacedFunction<&epoxy_glNamedBufferStorage>::driver(buffer, size, data, flags);
}

void APIENTRY buffer_part(GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data) {
    log->bytes += static_cast<std::size_t>(size);
    ReplacedFunction<&epoxy_glNamedBufferSubData>::driver(buffer, offset, size, data);
}

void APIENTRY line(GLuint texture, GLint level, GLint x, GLsizei width, GLenum format, GLenum type,
                   const void* texels) {
    count_texels(width, 1, 1, format, type);
    ReplacedFunction<&epoxy_glTextureSubImage1D>::driver(texture, level, x, width, format, type, texels);
}

void APIENTRY plane(GLuint texture, GLint level, GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                    GLenum type, const void* texels) {
    count_texels(width, height, 1, format, type);
    ReplacedFunction<&epoxy_glTextureSubImage2D>::driver(texture, level, x, y, width, height, format, type, texels);
}

void APIENTRY volume(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height,
                     GLsizei depth, GLenum format, GLenum type, const void* texels) {
    count_texels(width, height, depth, format, type);
    ReplacedFunction<&epoxy_glTextureSubImage3D>::driver(texture, level, x, y, z, width, height, depth, format, type,
                                                         texels);
}

void APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    log->shaders.push_back(whole_source(count, texts, lengths));
    ReplacedFunction<&epoxy_glShaderSource>::driver(shader, count, texts, lengths);
}

struct Replaced {
    ReplacedFunction<&epoxy_glNamedBufferStorage> storage{"glNamedBufferStorage", buffer_storage};
    ReplacedFunction<&epoxy_glNamedBufferSubData> part{"glNamedBufferSubData", buffer_part};
    ReplacedFunction<&epoxy_glTextureSubImage1D> of_line{"glTextureSubImage1D", line};
    ReplacedFunction<&epoxy_glTextureSubImage2D> of_plane{"glTextureSubImage2D", plane};
    ReplacedFunction<&epoxy_glTextureSubImage3D> of_volume{"glTextureSubImage3D", volume};
    ReplacedFunction<&epoxy_glShaderSource> source{"glShaderSource", shader_source};
};
std::optional<Replaced> replaced;

}  // namespace

UploadLog::UploadLog() {
    ROWLAND_CHECK(log == nullptr, "one log at a time");
    log = new Uploads;
    replaced.emplace();
}

UploadLog::~UploadLog() {
    replaced.reset();
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
