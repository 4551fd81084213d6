#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/image/byte_image.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/runtime/groove_moments.h"

namespace rowland::diffraction {

/// A texture that varies the grating over a surface. R: rotation / π, added to the surface's; G: half the pitch over
/// the material's, 0 for no grating. Pixels see the mean grooves of what they cover, and how these vary (PHYSICS §11);
/// with GrooveTexture::sparkle some of its facets, whose mean varies from pixel to pixel as that of all of them does.
class GrooveMap {
 public:
    /// The texture that the glTF extension at the JSON pointer `pointer` of `file` names. Throws Error (input) if there
    /// is none, or for other sets of texture coordinates than 0 and 1.
    GrooveMap(const GrooveTexture& use, render::SurfaceTextures& textures, const std::string& file,
              const std::string& pointer);

    const GroovePitches& pitches() const { return pitches_; }

    /// Radians at a vertex's texture coordinates, bilinear where the texture is.
    double rotation(const glm::vec2& uv) const;
    int uv_set() const { return use_.uv_set; }
    bool has_gaps() const { return gaps_; }
    const image::ByteImage* image() const { return image_.get(); }

    /// `even`: whether the material's kernel is, k(−x) = k(x).
    void add_defines(bool even, gpu::ProgramDesc& desc) const;
    void bind(bool even, const gpu::Program& program) const;

    /// The texture of groove_moments(), created at the first call.
    const gpu::Texture& moments(bool even) const;

 private:
    double red(int column, int row) const;

    scene::TextureUse use_;
    bool sparkle_ = false;
    bool gaps_ = false;
    double facet_texels_ = 1.0;                                   ///< of a texture that sparkles
    mutable std::array<std::optional<gpu::Texture>, 2> moments_;  ///< for other and for even kernels
    std::shared_ptr<const image::ByteImage> image_;
    scene::ImportedTexture sampling_;
    GroovePitches pitches_;
};

/// The mesh with its tangents rotated by the map at the vertices.
scene::Mesh turned_by(const GrooveMap& grooves, const scene::Mesh& mesh);

}  // namespace rowland::diffraction
