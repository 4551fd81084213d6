#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/byte_image.h"

namespace rowland::inspector {

/// A picture that a scene file does not hold yet.
struct NewTexture {
    std::string name;                                 ///< of the file it becomes
    std::vector<std::byte> bytes;                     ///< PNG or JPEG
    std::shared_ptr<const image::ByteImage> picture;  ///< decoded
};

/// Pictures that a scene's materials use before they are saved. They have texture indices that no file reaches.
class NewTextures {
 public:
    static constexpr std::size_t kFirst = 1'000'000;

    /// Adds a PNG or JPEG; returns its index, kFirst or above. Throws Error (input) naming `name` if it cannot be read.
    std::size_t add(std::vector<std::byte> bytes, const std::string& name) {
        auto picture = std::make_shared<const image::ByteImage>(image::decode_byte_image(bytes, name));
        all_.push_back(std::make_shared<const NewTexture>(NewTexture{name, std::move(bytes), std::move(picture)}));
        return kFirst + all_.size() - 1;
    }
    /// The texture of that index; null if there is none.
    std::shared_ptr<const NewTexture> find(std::size_t index) const {
        return index >= kFirst && index - kFirst < all_.size() ? all_[index - kFirst] : nullptr;
    }

 private:
    std::vector<std::shared_ptr<const NewTexture>> all_;
};

}  // namespace rowland::inspector
