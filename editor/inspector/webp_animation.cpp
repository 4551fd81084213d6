#include "editor/inspector/webp_animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace rowland::inspector {

namespace {

void require(bool done, WebPAnimEncoder* encoder) {
    if (!done)
        fail_system("", std::string("an animated WebP that cannot be encoded: ") +
                            (encoder != nullptr ? WebPAnimEncoderGetError(encoder) : "no memory"));
}

WebPAnimEncoder* make_encoder(int width, int height) {
    WebPAnimEncoderOptions options;
    require(WebPAnimEncoderOptionsInit(&options) != 0, nullptr);
    options.anim_params.loop_count = 0;  // without end
    return WebPAnimEncoderNew(width, height, &options);
}

}  // namespace

WebpAnimation::WebpAnimation(int width, int height, double seconds)
    : width_(width), height_(height), seconds_(seconds), encoder_(make_encoder(width, height), WebPAnimEncoderDelete) {
    require(encoder_ != nullptr, nullptr);
}

int WebpAnimation::time_ms() const {
    return static_cast<int>(std::lround(1000.0 * seconds_ * pictures_));
}

void WebpAnimation::add(std::span<const std::uint8_t> rgba) {
    ROWLAND_CHECK_OP(rgba.size(), ==, std::size_t{4} * static_cast<std::size_t>(width_ * height_));
    WebPConfig config;
    require(WebPConfigPreset(&config, WEBP_PRESET_PICTURE, 85.0F) != 0, nullptr);
    config.method = 3;  // faster than the default of 4
    WebPPicture picture;
    require(WebPPictureInit(&picture) != 0, nullptr);
    const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> released(&picture, WebPPictureFree);
    picture.width = width_;
    picture.height = height_;
    picture.use_argb = 1;
    require(WebPPictureImportRGBX(&picture, rgba.data(), 4 * width_) != 0, nullptr);
    require(WebPAnimEncoderAdd(encoder_.get(), &picture, time_ms(), &config) != 0, encoder_.get());
    ++pictures_;
}

std::vector<std::byte> WebpAnimation::finish() {
    require(WebPAnimEncoderAdd(encoder_.get(), nullptr, time_ms(), nullptr) != 0, encoder_.get());
    WebPData data;
    WebPDataInit(&data);
    const std::unique_ptr<WebPData, void (*)(WebPData*)> released(&data, WebPDataClear);
    require(WebPAnimEncoderAssemble(encoder_.get(), &data) != 0, encoder_.get());
    const auto* bytes = reinterpret_cast<const std::byte*>(data.bytes);
    return {bytes, bytes + data.size};
}

}  // namespace rowland::inspector
