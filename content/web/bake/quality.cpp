// The "quality" of a material file, for ports: its illuminant. The page chooses representations by the mesh.
#include "modules/diffraction/asset/quality_json.h"

namespace rowland::diffraction {

Quality parse_quality(JsonReader json, const Grating&, const ReadNamed&) {
    Quality quality;
    if (json.has("illuminant")) quality.illuminant = colour::illuminant(json.text("illuminant"));
    return quality;
}

}  // namespace rowland::diffraction
