#include "tests/gpu/wide_halves.h"

#include <glm/gtc/packing.hpp>
#include <optional>

#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

std::optional<ReplacedFunction<&epoxy_glTextureStorage2D>> storage;

void APIENTRY wide_storage(GLuint texture, GLsizei levels, GLenum format, GLsizei width, GLsizei height) {
    storage->driver(texture, levels, format == GL_RGBA16F ? GL_RGBA32F : format, width, height);
}

}  // namespace

WideHalves::WideHalves() {
    storage.emplace("glTextureStorage2D", wide_storage);
}

WideHalves::~WideHalves() {
    storage.reset();
}

int not_halves(const std::vector<glm::vec4>& pixels) {
    int count = 0;
    for (const glm::vec4& pixel : pixels)
        for (int c = 0; c < 4; ++c)
            if (glm::unpackHalf1x16(glm::packHalf1x16(pixel[c])) != pixel[c]) ++count;
    return count;
}

}  // namespace rowland::test
