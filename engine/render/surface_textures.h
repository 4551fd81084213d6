#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "engine/scene/imported_scene.h"

namespace rowland::render {

/// How an image's bytes are read.
enum class TexelMeaning {
    Linear,  ///< numbers: roughness
    Srgb,    ///< encoded colours; alpha is linear
    Normal,  ///< RGB: unit vectors. On the GPU, each level holds their normalised means and, in alpha, half the root of
             ///< the sum of their slopes' variances
};

/// How an imported texture is sampled: as its file says, anisotropic where it has levels, on a GPU.
gpu::Sampling sampling_of(const scene::ImportedTexture& texture);

/// An imported scene's textures on the GPU, uploaded on demand: one for each image, meaning and sampling.
class SurfaceTextures {
 public:
    /// `scene` must outlive it.
    explicit SurfaceTextures(const scene::ImportedScene& scene) : scene_(&scene) {}

    const scene::ImportedScene& scene() const { return *scene_; }

    SurfaceTexture get(const scene::TextureUse& use, TexelMeaning meaning);
    std::size_t uploads() const { return textures_.size(); }

 private:
    using Key = std::tuple<std::size_t, TexelMeaning, scene::TextureWrap, scene::TextureWrap, bool, bool>;

    const scene::ImportedScene* scene_;
    std::map<Key, std::shared_ptr<const gpu::Texture>> textures_;
};

/// A material as imported, with its textures. Null: glTF's default material.
StandardMaterial make_material(const scene::MaterialDescription* description, SurfaceTextures& textures);

}  // namespace rowland::render
