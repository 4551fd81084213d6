#include <fmt/format.h>

#include <exception>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/image/limits.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_buffer.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

using SharedImage = std::shared_ptr<const image::ByteImage>;

// Decoded images have a budget of their own: a dozen of 4096 × 4096 texels.
constexpr std::uint64_t kMaximumPictureBytes = std::uint64_t{1} << 30;

/// An image before it is decoded.
struct Encoded {
    std::size_t image = 0;
    GltfBuffer bytes;
};

/// Calls `read` and adds the file and the image to what it throws.
template <typename Read>
auto read_at(const std::string& file, std::size_t image, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        ErrorInfo info = error.info();
        info.file = file;
        info.location = fmt::format("/images/{}{}{}", image, info.location.empty() ? "" : ", ", info.location);
        throw Error(std::move(info));
    }
}

/// Throws Error (input) if highly compressed images would use memory out of proportion to the file.
void check_decoded_total(const std::vector<Encoded>& encoded, const std::string& file) {
    std::uint64_t decoded = 0;
    std::uint64_t bytes = 0;
    for (const Encoded& picture : encoded) {
        const image::ByteImageSize size = image::byte_image_size(picture.bytes.bytes, file);
        decoded += 4 * static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
        bytes += picture.bytes.bytes.size();
    }
    if (const std::uint64_t limit = image::decoded_limit(bytes); decoded > limit)
        refuse_input(file, "/images", fmt::format("{} bytes of images that decode to {}", bytes, decoded),
                     fmt::format("at most {}", limit), "scale the images down");
}

/// The images that a texture names, their bytes fetched and the memory they take once decoded spent.
std::vector<Encoded> fetch(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                           std::vector<std::filesystem::path>* read_files) {
    std::vector<bool> named(document.images.size(), false);
    for (const GltfTexture& texture : document.textures)
        if (texture.image) named[*texture.image] = true;
    MemoryBudget pictures(document.file, kMaximumPictureBytes);
    std::vector<Encoded> encoded;
    for (std::size_t i = 0; i < document.images.size(); ++i) {
        if (!named[i]) continue;
        const GltfImage& from = document.images[i];
        const std::string pointer = fmt::format("/images/{}", i);
        Encoded& added = encoded.emplace_back(Encoded{i, {}});
        if (from.view)
            added.bytes.bytes = view_bytes(document, *from.view);
        else
            added.bytes = load_uri(source, from.uri, pointer, budget, read_files);
        const image::ByteImageSize size =
            read_at(document.file, i, [&] { return image::byte_image_size(added.bytes.bytes, ""); });
        pictures.spend(static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height), 4, pointer);
    }
    check_decoded_total(encoded, document.file);
    return encoded;
}

/// Decodes each into its element of `images`, on all cores.
void decode(const std::vector<Encoded>& encoded, const std::string& file, std::vector<SharedImage>& images) {
    // The first broken image is named, whichever thread finishes first.
    std::vector<std::exception_ptr> refusals(encoded.size());
    parallel_for(encoded.size(), [&](std::size_t i) {
        try {
            images[encoded[i].image] = read_at(file, encoded[i].image, [&] {
                return std::make_shared<const image::ByteImage>(image::decode_byte_image(encoded[i].bytes.bytes, ""));
            });
        } catch (const Error&) {
            refusals[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& refusal : refusals)
        if (refusal) std::rethrow_exception(refusal);
}

}  // namespace

void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene) {
    const auto white = std::make_shared<const image::ByteImage>(image::ByteImage{1, 1, {255, 255, 255, 255}});
    scene.images.assign(document.images.size(), white);
    decode(fetch(source, document, budget, read_files), document.file, scene.images);
    for (const GltfTexture& texture : document.textures) {
        ImportedTexture& added = scene.textures.emplace_back(texture.settings);
        added.image = texture.image.value_or(scene.images.size());
        if (!texture.image) scene.images.push_back(white);
    }
}

}  // namespace rowland::scene
