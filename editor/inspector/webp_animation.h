#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct WebPAnimEncoder;  // of webp/mux.h

namespace rowland::inspector {

/// An animated WebP that repeats without end. Throws Error (system) where the encoder fails.
class WebpAnimation {
 public:
    /// Every picture is shown for `seconds`.
    WebpAnimation(int width, int height, double seconds);

    /// Adds a picture: width·height·4 bytes, row by row from the top. Alpha is not kept.
    void add(std::span<const std::uint8_t> rgba);
    /// The file's bytes. Call it last.
    std::vector<std::byte> finish();

 private:
    int time_ms() const;

    int width_;
    int height_;
    double seconds_;
    int pictures_ = 0;
    std::unique_ptr<WebPAnimEncoder, void (*)(WebPAnimEncoder*)> encoder_;
};

}  // namespace rowland::inspector
