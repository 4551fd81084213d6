// Gratings on a GPU that allows little.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/gpu/lowered_limit.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/support/message_of.h"

namespace rowland::diffraction {
namespace {

using rowland::test::LoweredLimit;
using rowland::test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

class GratingLimits : public GratingPicture {
 protected:
    std::string refusal(const std::string& representation) {
        const CookedMaterial cooked = cook(kSlitCd, "{\"representation\": \"" + representation + "\"}");
        if (!renderer_) show(cooked);
        use(cooked);
        return message_of([&] { draw(); }, Fault::System);
    }
};

/// Three vertices: 25 coefficients, or two layers of three vectors.
TEST_F(GratingLimits, LightOfMoreThanABufferHoldsIsRefused) {
    {
        const LoweredLimit limit(GL_MAX_TEXTURE_BUFFER_SIZE, 74);
        EXPECT_THAT(refusal("spikes"), AllOf(HasSubstr("representation spikes on 3 vertices"), HasSubstr("75 texels"),
                                             HasSubstr("at most 74"), HasSubstr("fewer bands")));
    }
    const LoweredLimit limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 287);
    EXPECT_THAT(refusal("arc"), HasSubstr("288 bytes"));
}

TEST_F(GratingLimits, AVertexStageWithoutStorageDrawsWhatNeedsNone) {
    const LoweredLimit limit(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0);
    for (const char* representation : {"spikes", "bins", "transfer", "arc"})
        EXPECT_THAT(refusal(representation), HasSubstr("1 storage buffers")) << representation;
    for (const char* quality :
         {R"({"representation": "direct"})", R"({"representation": "circle", "map_resolution": 8})"}) {
        use(cook(kSlitCd, quality));
        EXPECT_NO_THROW(draw()) << quality;
    }
}

}  // namespace
}  // namespace rowland::diffraction
