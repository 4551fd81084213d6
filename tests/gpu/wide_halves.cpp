#include "tests/gpu/wide_halves.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <glm/gtc/packing.hpp>
#include <utility>

namespace rowland::test {

namespace {

void APIENTRY wide_storage(GLuint texture, GLsizei levels, GLenum format, GLsizei width, GLsizei height) {
    const auto driver = reinterpret_cast<PFNGLTEXTURESTORAGE2DPROC>(eglGetProcAddress("glTextureStorage2D"));
    driver(texture, levels, format == GL_RGBA16F ? GL_RGBA32F : format, width, height);
}

/// Exchanges epoxy's pointer for the one kept here: again, and all is as before.
void exchange_storage() {
    static PFNGLTEXTURESTORAGE2DPROC kept_storage = wide_storage;
    std::swap(epoxy_glTextureStorage2D, kept_storage);
}

}  // namespace

WideHalves::WideHalves() {
    exchange_storage();
}

WideHalves::~WideHalves() {
    exchange_storage();
}

int not_halves(const std::vector<glm::vec4>& pixels) {
    int count = 0;
    for (const glm::vec4& pixel : pixels)
        for (int c = 0; c < 4; ++c)
            if (glm::unpackHalf1x16(glm::packHalf1x16(pixel[c])) != pixel[c]) ++count;
    return count;
}

}  // namespace rowland::test
