#include "engine/image/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>

#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image.h"

namespace rowland::image {

namespace {

/// Rows decoded at a time: a multiple of every compression's block of scanlines, so that none is decoded twice.
constexpr int kRowsAtATime = 256;

/// OpenEXR's input, from memory.
class SpanStream : public Imf::IStream {
 public:
    explicit SpanStream(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}

    bool read(char target[], int count) override {
        const auto size = static_cast<std::size_t>(std::max(count, 0));
        if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_)
            throw std::runtime_error("the file is truncated");
        std::memcpy(target, bytes_.data() + position_, size);
        position_ += size;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

 private:
    std::span<const std::byte> bytes_;
    std::uint64_t position_ = 0;
};

/// The names of the channels that become red, green and blue.
using ChannelNames = std::array<std::string, 3>;
const ChannelNames kRgb{"R", "G", "B"};
const ChannelNames kXyz{"X", "Y", "Z"};  ///< CIE 1931 tristimulus values

/// R, G and B of the unnamed layer, else X, Y and Z, else Y, else R, G and B of the first layer that has them.
std::optional<ChannelNames> pick_channels(const Imf::ChannelList& channels) {
    const auto has = [&channels](const std::string& name) { return channels.findChannel(name) != nullptr; };
    const auto all = [&has](const ChannelNames& names) { return has(names[0]) && has(names[1]) && has(names[2]); };
    if (all(kRgb)) return kRgb;
    if (all(kXyz)) return kXyz;
    // Y beside RY and BY is luminance and chroma; beside X or Z it is a part of something else.
    if (has("Y") && !has("RY") && !has("BY") && !has("X") && !has("Z")) return ChannelNames{"Y", "Y", "Y"};
    for (auto it = channels.begin(); it != channels.end(); ++it) {
        const std::string name = it.name();
        if (!name.ends_with(".R")) continue;
        const std::string layer = name.substr(0, name.size() - 1);
        if (const ChannelNames names{layer + "R", layer + "G", layer + "B"}; all(names)) return names;
    }
    return std::nullopt;
}

std::string list_channels(const Imf::ChannelList& channels) {
    std::string text;
    for (auto it = channels.begin(); it != channels.end() && text.size() < 80; ++it)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", it.name());
    return text.empty() ? "no channels" : "channels " + text;
}

ChannelNames usable_channels(const Imf::ChannelList& channels, const std::string& file) {
    const auto names = pick_channels(channels);
    if (!names) refuse_input(file, "channels", list_channels(channels), "R, G and B, or X, Y and Z, or Y");
    for (const std::string& name : *names) {
        const Imf::Channel& channel = channels[name];
        if (channel.type != Imf::HALF && channel.type != Imf::FLOAT)
            refuse_input(file, "channel " + name, "integers", "half or float");
        if (channel.xSampling != 1 || channel.ySampling != 1)
            refuse_input(file, "channel " + name, "a subsampled channel", "one sample per texel");
    }
    return *names;
}

/// Reads rows [first, last] of the data window into `rows`, the first row first.
void read_rows(Imf::InputPart& part, const ChannelNames& names, const Imath::Box2i& window, int first, int last,
               glm::vec3* rows) {
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < 3; ++c) {
        if (c > 0 && names[c] == names[0]) break;
        buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, reinterpret_cast<float*>(rows) + c, {window.min.x, first},
                                                 static_cast<std::int64_t>(width), last - first + 1, sizeof(glm::vec3),
                                                 sizeof(glm::vec3) * width));
    }
    part.setFrameBuffer(buffer);
    part.readPixels(first, last);
    if (names[1] != names[0]) return;
    const std::size_t count = width * (static_cast<std::size_t>(last - first) + 1);
    for (std::size_t i = 0; i < count; ++i) rows[i] = glm::vec3(rows[i].x);
}

/// The matrix from the channels to Rec.709; nullopt if they are Rec.709.
std::optional<glm::dmat3> conversion(const Imf::Header& header, const ChannelNames& names, const std::string& file) {
    if (names == kXyz) return colour::xyz_to_rec709();
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    const auto xy = [](const Imath::V2f& v) { return glm::dvec2(v.x, v.y); };
    const colour::Primaries primaries{xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
    if (!colour::is_usable(primaries))
        refuse_input(file, "chromaticities", "chromaticities of no colour space", "primaries that span a triangle");
    return colour::to_rec709(primaries);
}

Image read_part(Imf::InputPart& part, const std::string& file) {
    const Imf::Header& header = part.header();
    const Imath::Box2i window = header.dataWindow();
    if (window != header.displayWindow())
        refuse_input(file, "dataWindow", "a data window that is not the display window", "a whole image",
                     "crop or pad the image so that both agree");
    if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
        refuse_input(file, "envmap", "a cube map", "an equirectangular (latitude-longitude) or angular map",
                     "convert it, for example with exrenvmap -l");
    const ChannelNames names = usable_channels(header.channels(), file);
    const std::optional<glm::dmat3> to_rec709 = conversion(header, names, file);

    // check_exr_header() has limited the size.
    Image image = make_image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    for (int row = 0; row < image.height; row += kRowsAtATime) {
        const int last = std::min(image.height, row + kRowsAtATime) - 1;
        read_rows(part, names, window, window.min.y + row, window.min.y + last, &image.at(0, row));
    }
    if (to_rec709) transform_colours(image, *to_rec709);
    return image;
}

}  // namespace

bool is_exr(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

Image read_exr(std::span<const std::byte> bytes, const std::string& file) {
    check_exr_header(bytes, file);
    try {
        SpanStream stream(bytes);
        // No threads of the library's own, and no guessing at a broken offset table.
        Imf::MultiPartInputFile input(stream, 0, false);
        Imf::InputPart part(input, 0);
        return read_part(part, file);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        std::string reason = error.what();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        refuse_input(file, "", fmt::format("OpenEXR refuses it: {}", reason), "a sound OpenEXR image",
                     "the file is damaged or truncated; get it again");
    }
}

void write_exr(const std::filesystem::path& path, const Image& image) {
    ROWLAND_CHECK_OP(image.width, >=, 1);
    ROWLAND_CHECK_OP(image.height, >=, 1);
    const auto width = static_cast<std::size_t>(image.width);
    ROWLAND_CHECK_OP(image.texels.size(), ==, width * static_cast<std::size_t>(image.height));
    const auto* const floats = reinterpret_cast<const float*>(image.texels.data());
    Imf::StdOSStream stream;
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;  // deterministic and lossless
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < kRgb.size(); ++c) {
            header.channels().insert(kRgb[c], Imf::Channel(Imf::FLOAT));
            buffer.insert(kRgb[c], Imf::Slice::Make(Imf::FLOAT, floats + c, {0, 0}, image.width, image.height,
                                                    sizeof(glm::vec3), sizeof(glm::vec3) * width));
        }
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail_system(path.string(), fmt::format("encoding OpenEXR failed: {}", error.what()));
    }
    write_file_atomic(path, stream.str());
}

}  // namespace rowland::image
