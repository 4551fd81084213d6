#include "tests/support/eight_bit_filtering.h"

#include <optional>

#include "engine/core/error.h"
#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

/// The look-ups of a shader, by positions with 8 bits of fraction. HALF_STEP: what is added before the rest is cut off.
/// A fraction stays on its side of one half, so that the nearest texel is the same one.
constexpr std::string_view kLookUps = R"(
vec3 eight_bits(vec3 position, vec3 size) {
    vec3 texels = position * size - 0.5;
    vec3 low = floor(texels);
    vec3 exact = texels - low;
    vec3 fraction = floor(exact * 256.0 + HALF_STEP) / 256.0;
    fraction = mix(max(fraction, 0.5), min(fraction, 0.49998), lessThan(exact, vec3(0.5)));
    return (low + fraction + 0.5) / size;
}
vec2 eight_bits(vec2 position, ivec2 size) { return eight_bits(vec3(position, 0.0), vec3(size, 1)).xy; }
vec3 eight_bits(vec3 position, ivec3 size) { return eight_bits(position, vec3(size)); }
float eight_bits(float position, int size) { return eight_bits(vec2(position, 0.0), ivec2(size, 1)).x; }

float at_level(sampler1D t, float p) { return eight_bits(p, textureSize(t, 0)); }
vec2 at_level(sampler2D t, vec2 p) { return eight_bits(p, textureSize(t, 0)); }
vec3 at_level(sampler2DArray t, vec3 p) { return vec3(eight_bits(p.xy, textureSize(t, 0).xy), p.z); }
vec3 at_level(sampler3D t, vec3 p) { return eight_bits(p, textureSize(t, 0)); }
vec3 at_level(sampler2DShadow t, vec3 p) { return vec3(eight_bits(p.xy, textureSize(t, 0)), p.z); }
// On the face that the direction meets: the largest component is no position on it.
vec3 at_level(samplerCube t, vec3 p, int level) {
    vec3 a = abs(p);
    float largest = max(a.x, max(a.y, a.z));
    vec3 face = p / largest;
    vec3 on_it = 2.0 * eight_bits(0.5 * face + 0.5, vec3(textureSize(t, level).x)) - 1.0;
    return mix(on_it, face, equal(a, vec3(largest)));
}

vec4 filtered_lod(sampler1D t, float p, float level) { return textureLod(t, at_level(t, p), level); }
vec4 filtered_lod(sampler2D t, vec2 p, float level) { return textureLod(t, at_level(t, p), level); }
vec4 filtered_lod(sampler2DArray t, vec3 p, float level) { return textureLod(t, at_level(t, p), level); }
vec4 filtered_lod(sampler3D t, vec3 p, float level) { return textureLod(t, at_level(t, p), level); }
// Both levels by the position on the finer one: llvmpipe has one level for four pixels, so they cannot be read apart.
vec4 filtered_lod(samplerCube t, vec3 p, float level) {
    float between = clamp(floor(level * 256.0 + HALF_STEP) / 256.0, 0.0, float(textureQueryLevels(t) - 1));
    return textureLod(t, at_level(t, p, int(between)), between);
}
#if FRAGMENT
vec4 filtered(sampler1D t, float p) { return textureGrad(t, at_level(t, p), dFdx(p), dFdy(p)); }
vec4 filtered(sampler2D t, vec2 p) { return textureGrad(t, at_level(t, p), dFdx(p), dFdy(p)); }
vec4 filtered(sampler2DArray t, vec3 p) { return textureGrad(t, at_level(t, p), dFdx(p.xy), dFdy(p.xy)); }
vec4 filtered(sampler3D t, vec3 p) { return textureGrad(t, at_level(t, p), dFdx(p), dFdy(p)); }
vec4 filtered(samplerCube t, vec3 p) { return textureGrad(t, at_level(t, p, 0), dFdx(p), dFdy(p)); }
float filtered(sampler2DShadow t, vec3 p) { return texture(t, at_level(t, p)); }
#else
vec4 filtered(sampler1D t, float p) { return filtered_lod(t, p, 0.0); }
vec4 filtered(sampler2D t, vec2 p) { return filtered_lod(t, p, 0.0); }
vec4 filtered(sampler2DArray t, vec3 p) { return filtered_lod(t, p, 0.0); }
vec4 filtered(sampler3D t, vec3 p) { return filtered_lod(t, p, 0.0); }
vec4 filtered(samplerCube t, vec3 p) { return filtered_lod(t, p, 0.0); }
#endif
#define texture(t, position) filtered(t, position)
#define textureLod(t, position, level) filtered_lod(t, position, level)
#line 2
)";

Fraction asked_fraction = Fraction::Rounded;

std::optional<ReplacedFunction<&epoxy_glShaderSource>> filtered;

void APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    GLint stage = 0;
    glGetShaderiv(shader, GL_SHADER_TYPE, &stage);
    const std::string text =
        with_eight_bit_filtering(whole_source(count, texts, lengths), stage == GL_FRAGMENT_SHADER, asked_fraction);
    const GLchar* begin = text.c_str();
    filtered->driver(shader, 1, &begin, nullptr);
}

}  // namespace

std::string with_eight_bit_filtering(std::string_view shader, bool is_fragment, Fraction fraction) {
    constexpr std::string_view kVersion = "#version 450";
    const std::size_t line = shader.find('\n');
    if (!shader.starts_with(kVersion) || line == std::string_view::npos) return std::string(shader);
    const auto has = [&](std::string_view word) { return shader.find(word) != std::string_view::npos; };
    if (!has("texture") || has("HALF_STEP")) return std::string(shader);
    std::string text(shader.substr(0, line + 1));
    text += fraction == Fraction::Rounded ? "#define HALF_STEP 0.5\n" : "#define HALF_STEP 0.0\n";
    text += is_fragment ? "#define FRAGMENT 1" : "#define FRAGMENT 0";
    text += kLookUps;
    return text += shader.substr(line + 1);
}

void filter_as_asked() {
    constexpr const char* kVariable = "ROWLAND_TEST_FILTERING";
    const char* asked = std::getenv(kVariable);
    if (asked == nullptr || filtered) return;
    const std::string_view name(asked);
    if (name != "rounded" && name != "truncated")
        refuse_input(kVariable, "", "\"" + std::string(name) + "\"", "\"rounded\" or \"truncated\"");
    asked_fraction = name == "rounded" ? Fraction::Rounded : Fraction::Truncated;
    filtered.emplace("glShaderSource", shader_source);
}

}  // namespace rowland::test
