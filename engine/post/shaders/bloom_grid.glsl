// The grids of bloom.h: texels hold light in rgb and area in alpha, relative to those of a texel inside the picture.

#include "engine/gpu/shaders/dialect.glsl"

layout(binding = 0) uniform sampler2D fine;

// Components that are not finite count as 0, others are clamped to the half floats' range. Bits are tested, because
// compilers may assume that isnan is false.
vec3 usable(vec3 colour) {
    bvec3 is_finite = lessThan(floatBitsToUint(colour) & 0x7fffffffu, uvec3(0x7f800000u));
    return clamp(mix(vec3(0.0), colour, is_finite), -65504.0, 65504.0);
}

vec4 fine_texel(ivec2 position) {
    vec4 texel = texelFetch(fine, position, 0);
#if FINE_IS_PICTURE
    return vec4(usable(texel.rgb), 1.0);
#else
    return texel;
#endif
}

// Where the centre of a fine texel lies among the centres of the coarse ones.
vec2 coarse_position(ivec2 fine_position, ivec2 coarse_size) {
    return clamp(0.5 * (vec2(fine_position) + 0.5) - 0.5, vec2(0.0), vec2(coarse_size - 1));
}
