#include "tests/benchmark/even_grooves.h"

namespace rowland::benchmark {

namespace {

constexpr int kSide = 256;
constexpr std::uint8_t kRotation = 64;  ///< π / 4
constexpr std::uint8_t kPitch = 128;    ///< half of the range: the material's

}  // namespace

std::shared_ptr<const diffraction::GrooveMap> even_grooves() {
    auto picture = std::make_shared<image::ByteImage>();
    picture->width = kSide;
    picture->height = kSide;
    for (int i = 0; i < kSide * kSide; ++i)
        picture->rgba.insert(picture->rgba.end(), {kRotation, kPitch, std::uint8_t{0}, std::uint8_t{255}});
    scene::ImportedScene scene;
    scene.images = {picture};
    scene.textures = {{}};
    render::SurfaceTextures textures(scene);
    return std::make_shared<const diffraction::GrooveMap>(diffraction::GrooveTexture{}, textures, "groove map", "");
}

}  // namespace rowland::benchmark
