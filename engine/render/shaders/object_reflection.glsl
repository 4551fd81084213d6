// What a reflected ray meets among the objects around its mirror: engine/render/object_reflection.h.
TEXTURE_UNIT(19) uniform samplerCube surrounding_light;     // times coverage; alpha: coverage
TEXTURE_UNIT(20) uniform samplerCube surrounding_nearness;  // 1 / distance from the centre, metres; 0: nothing
uniform vec4 surroundings;  // xyz: the centre, world; w: angle of a texel, radians

const int MARCH_STEPS = 16;
const int HALVINGS = 5;

// The light from a direction: that of the object which the ray meets in place of `beyond`. A ray's point that is seen
// from the centre at an angle a from the ray's direction lies at r / sin(a), where r is the ray's least distance.
vec3 with_object_reflection(vec3 beyond, vec3 direction, float roughness) {
    vec3 turn = fwidth(direction);
    vec3 from = world_position - surroundings.xyz;
    float along = dot(from, direction);
    vec3 foot = from - along * direction;
    float least = max(length(foot), 1e-6);
    vec3 aside = foot / least;
    float begin = atan(least, along);
    float met = -1.0;  // beyond the last angle that is known to lie before an object
    for (int i = 1; i <= MARCH_STEPS && met < 0.0; ++i) {
        float angle = begin * (1.0 - float(i) / float(MARCH_STEPS));
        vec3 toward = sin(angle) * aside + cos(angle) * direction;
        if (textureLod(surrounding_nearness, toward, 0.0).r * least > sin(angle)) met = angle;
    }
    if (met < 0.0) return beyond;
    float before = met + begin / float(MARCH_STEPS);
    for (int i = 0; i < HALVINGS; ++i) {
        float angle = 0.5 * (before + met);
        vec3 toward = sin(angle) * aside + cos(angle) * direction;
        if (textureLod(surrounding_nearness, toward, 0.0).r * least > sin(angle)) met = angle;
        else before = angle;
    }
    // A lobe as wide as a plane sees it (local_reflection.glsl), and what the pixel covers.
    float footprint = 2.0 * roughness * roughness + max(turn.x, max(turn.y, turn.z));
    vec3 toward = sin(met) * aside + cos(met) * direction;
    vec4 light = textureLod(surrounding_light, toward, log2(max(footprint / surroundings.w, 1.0)));
    return beyond * (1.0 - light.a) + light.rgb;
}
