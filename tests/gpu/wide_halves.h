#pragma once

#include <glm/vec4.hpp>
#include <vector>

namespace rowland::test {

/// While it lives, textures of half floats hold 32-bit floats: what a shader writes is not rounded by the driver. It
/// stands between the program and OpenGL. One at a time.
class WideHalves {
 public:
    WideHalves();
    ~WideHalves();
    WideHalves(const WideHalves&) = delete;
    WideHalves& operator=(const WideHalves&) = delete;
};

/// How many components are not half floats.
int not_halves(const std::vector<glm::vec4>& pixels);

}  // namespace rowland::test
