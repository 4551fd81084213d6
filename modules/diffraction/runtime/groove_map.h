#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "engine/gpu/program.h"
#include "engine/image/byte_image.h"
#include "engine/render/material.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A texture that varies the grating over a surface. R: rotation / π, added to the surface's; G: half the pitch over
/// the material's; 0: no grating.
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
    int uv_set() const { return texture_.uv_set; }

    void add_defines(gpu::ProgramDesc& desc) const;
    void bind(const gpu::Program& program) const;

 private:
    double red(int column, int row) const;

    render::SurfaceTexture texture_;
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
