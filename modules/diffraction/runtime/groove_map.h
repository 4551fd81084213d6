#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/image/byte_image.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A texture that varies the grating over a surface. R: rotation / π, added to the surface's; G: half the pitch over
/// the material's; 0: no grating. Pixels see the mean grooves of what they cover, and how these vary (PHYSICS §11);
/// with GrooveTexture::sparkle those of one texel.
class GrooveMap {
 public:
    /// The texture that the glTF extension at the JSON pointer `pointer` of `file` names. Throws Error (input) if there
    /// is none.
    GrooveMap(const GrooveTexture& use, render::SurfaceTextures& textures, const std::string& file,
              const std::string& pointer);

    /// The range of the factors above 0; 1 if there are none.
    double smallest_pitch() const { return smallest_pitch_; }
    double largest_pitch() const { return largest_pitch_; }

    /// Radians at a vertex's texture coordinates, bilinear where the texture is.
    double rotation(const glm::vec2& uv) const;
    int uv_set() const { return use_.uv_set; }
    const image::ByteImage* image() const { return image_.get(); }

    /// `even`: whether the material's kernel is, k(−x) = k(x).
    void add_defines(bool even, gpu::ProgramDesc& desc) const;
    void bind(bool even, const gpu::Program& program) const;

    /// The moments of groove_moments.h. Created at the first call.
    const gpu::Texture& moments(bool even) const;

 private:
    double red(int column, int row) const;

    scene::TextureUse use_;
    bool sparkle_ = false;
    bool gaps_ = false;
    mutable std::array<std::optional<gpu::Texture>, 2> moments_;  ///< for other and for even kernels
    std::shared_ptr<const image::ByteImage> image_;
    scene::ImportedTexture sampling_;
    double smallest_pitch_ = 1.0;
    double largest_pitch_ = 1.0;
};

/// Why a material cannot be drawn under a map: its representation supports one direction or one pitch only. nullopt if
/// it can. The key is a JSON pointer relative to the glTF extension, without its first slash.
std::optional<Refusal> groove_refusal(const Material& material, const GrooveMap& grooves);

/// The material with the pitches of a map for which groove_refusal() is nullopt; arc, if nothing is pinned.
Material suited_to_grooves(Material material, const GrooveMap& grooves);

/// The mesh with its tangents rotated by the map at the vertices.
scene::Mesh turned_by(const GrooveMap& grooves, const scene::Mesh& mesh);

}  // namespace rowland::diffraction
