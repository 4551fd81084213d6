// The whole probe as a cube map of box-filtered levels, and its mean over a footprint: bake/cube_pyramid.h. The program
// defines FILTER_TAPS, the most samples.
layout(binding = 12) uniform samplerCube radiance_cube;
uniform float radiance_scale;  // of the stored values

const float TEXELS_PER_WIDTH = 0.57735026918962576;
const float FACE_ANGLE = 1.44720250911653531;

// Mean over the parallelogram that a and b span about a unit direction; all in the frame whose axes are the columns of
// `axes`. Linear Rec.709.
vec3 mean_radiance(vec3 direction, vec3 a, vec3 b, mat3 axes) {
    // The ellipse of the same second moments: squares of its axes.
    float half_sum = 0.5 * (dot(a, a) + dot(b, b));
    float half_difference = 0.5 * (dot(a, a) - dot(b, b));
    float mixed = dot(a, b);
    float root = length(vec2(half_difference, mixed));
    float major = sqrt(half_sum + root);
    float texel_angle = FACE_ANGLE / float(textureSize(radiance_cube, 0).x);
    float minor = max(sqrt(max(half_sum - root, 0.0)), texel_angle / TEXELS_PER_WIDTH);
    float taps = clamp(ceil(major / minor - 0.5), 1.0, FILTER_TAPS);
    float level = log2(max(minor, major / taps) * TEXELS_PER_WIDTH / texel_angle);
    if (taps == 1.0) return radiance_scale * textureLod(radiance_cube, axes * direction, level).rgb;
    // Its longer axis is cos t a + sin t b, with (cos 2t, sin 2t) = (half_difference, mixed) / root.
    float twice = half_difference / root;
    vec3 along = sqrt(max(0.5 + 0.5 * twice, 0.0)) * a +
                 (mixed < 0.0 ? -1.0 : 1.0) * sqrt(max(0.5 - 0.5 * twice, 0.0)) * b;
    vec3 sum = vec3(0.0);
    for (float i = 0.5; i < taps; i += 1.0)
        sum += textureLod(radiance_cube, axes * (direction + (i / taps - 0.5) * along), level).rgb;
    return radiance_scale / taps * sum;
}
