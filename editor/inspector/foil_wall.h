#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "editor/inspector/foil_recipe.h"
#include "engine/core/computed.h"
#include "engine/gpu/texture.h"
#include "modules/diffraction/foil/thumbnail.h"

namespace rowland::inspector {

/// Thumbnails of all types of foil on one card, in the order of foil_type_names(), made on another thread.
class FoilWall {
 public:
    /// Call it every frame. `may_begin`: whether new thumbnails may be begun. Returns whether there is a new one.
    bool update(const FoilRecipe& recipe, bool may_begin);
    bool busy() const { return made_.busy(); }

    /// Draws the thumbnails of cards that are tilted. `tilt`: from the card's axes to those of the eye. Needs a current
    /// context.
    void draw(const glm::quat& tilt);
    /// What draw() drew of a type; null: there is no thumbnail yet.
    const gpu::Texture* picture(std::size_t type) const;

 private:
    struct Made {
        std::string key;  ///< the recipe's text
        std::shared_ptr<const diffraction::foil::Thumbnail> thumbnail;
    };
    using All = std::vector<Made>;  ///< by type

    struct Drawn {
        std::shared_ptr<const diffraction::foil::Thumbnail> thumbnail;
        glm::quat tilt{1.0F, 0.0F, 0.0F, 0.0F};
        gpu::Texture texture;
    };

    std::vector<Drawn> drawn_;
    std::vector<std::uint8_t> rgba_;
    Computed<std::vector<std::string>, All> made_;
};

}  // namespace rowland::inspector
