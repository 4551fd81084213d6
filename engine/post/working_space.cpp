#include "engine/post/working_space.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <optional>
#include <string>

#include "engine/colour/working_space.h"
#include "engine/core/error.h"
#include "engine/core/log.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr const char* aces_interchange = "aces_interchange";
constexpr const char* xyz_interchange = "cie_xyz_d65_interchange";

OCIO::TransformRcPtr builtin(const char* style) {
    const OCIO::BuiltinTransformRcPtr transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    return transform;
}

OCIO::TransformRcPtr between_spaces(const char* from, const char* to) {
    const OCIO::ColorSpaceTransformRcPtr transform = OCIO::ColorSpaceTransform::Create();
    transform->setSrc(from);
    transform->setDst(to);
    return transform;
}

bool is_scene_space(const OcioConfig& config, const char* role) {
    if (!config.ocio()->hasRole(role)) return false;
    return config.ocio()->getColorSpace(role)->getReferenceSpaceType() == OCIO::REFERENCE_SPACE_SCENE;
}

/// ACEScg → scene_linear as OpenColorIO sees it.
OCIO::GroupTransformRcPtr acescg_to_scene_linear_transform(const OcioConfig& config) {
    OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(builtin("ACEScg_to_ACES2065-1"));
    if (is_scene_space(config, aces_interchange)) {
        group->appendTransform(between_spaces(aces_interchange, OCIO::ROLE_SCENE_LINEAR));
    } else if (is_scene_space(config, xyz_interchange)) {
        group->appendTransform(builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD"));
        group->appendTransform(between_spaces(xyz_interchange, OCIO::ROLE_SCENE_LINEAR));
    } else {
        log_warning("{}: no role {}, so scene_linear is taken to be ACEScg; add the role if it is not", config.source(),
                    aces_interchange);
        return OCIO::GroupTransform::Create();
    }
    return group;
}

/// The images of the unit vectors, if the processor maps a further vector as their matrix does.
std::optional<glm::dmat3> as_matrix(const OCIO::ConstCPUProcessorRcPtr& processor) {
    const auto image = [&](glm::vec3 value) {
        processor->applyRGB(&value.x);
        return glm::dvec3(value);
    };
    const glm::dmat3 matrix(image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1}));
    const glm::vec3 probe(4.0F, -0.5F, 0.125F);
    const double difference = glm::length(matrix * glm::dvec3(probe) - image(probe));
    // A few float roundings of numbers near 4; a curve or an offset is off by far more.
    if (!(difference < 1e-4)) return std::nullopt;
    return matrix;
}

[[noreturn]] void fail(const OcioConfig& config, std::string found) {
    refuse_input(config.source(), "role scene_linear", std::move(found), "a colour space that is linear in XYZ",
                 "set the role scene_linear, to ACEScg for one");
}

}  // namespace

glm::dmat3 xyz_to_scene_linear(const OcioConfig& config) {
    if (!config.ocio()->hasRole(OCIO::ROLE_SCENE_LINEAR)) fail(config, "no such role");
    try {
        const OCIO::ConstProcessorRcPtr processor =
            config.ocio()->getProcessor(acescg_to_scene_linear_transform(config));
        if (const auto matrix = as_matrix(processor->getDefaultCPUProcessor()))
            return *matrix * colour::xyz_to_acescg();
    } catch (const OCIO::Exception& exception) {
        fail(config, exception.what());
    }
    fail(config, "a colour space that is not linear");
}

glm::vec3 luminance_weights(const OcioConfig& config) {
    return {glm::row(glm::inverse(xyz_to_scene_linear(config)), 1)};
}

}  // namespace rowland::post
