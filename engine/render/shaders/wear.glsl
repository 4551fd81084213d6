// Marks of use: dust covers what lies under it, grease scatters what the surface mirrors, and a scratch diffracts light
// as a single slit does, into the cone of directions that have one angle to the scratch. The map and its coverage:
// engine/scene/wear.h. The program defines WEAR_SCRATCHES where the material has some.
#ifdef WEAR_MAP
TEXTURE_UNIT(22) uniform sampler2D wear_map;

const vec3 DUST_ALBEDO = vec3(0.5, 0.48, 0.45);
const float GREASE_ROUGHNESS = 0.5;
const float SCRATCH_VARIANCE = 4e-4;    // of the direction cosines along a scratch
const float SCRATCH_ROUGHNESS = 0.45;   // of the look-ups along its arc
const vec3 LAMBDA = vec3(0.61, 0.55, 0.465);  // micrometres, of the working space's primaries

struct Wear {
    float dust;       // coverage
    float grease;
    vec3 light;       // radiance of dust and scratches under the scene's lights
#ifdef WEAR_SCRATCHES
    float scratched;
    float width;      // of the scratch, micrometres
    vec3 along;       // unit, the scratch in the surface
    vec3 across;
    vec3 reflectance; // of the surface without it
#endif
};
Wear wear;

#ifdef WEAR_SCRATCHES
// 0 for a vector of 0, as where texture coordinates do not change.
vec3 unit_or_zero(vec3 a) { return a * inversesqrt(max(dot(a, a), 1e-30)); }

// Reads the scratch at a pixel. `twice`: cosine and sine of twice its angle in the map, times its coverage.
void read_scratch(vec2 at, vec2 twice, vec3 n, vec3 reflectance) {
    vec2 right = dFdx(at);
    vec2 up = dFdy(at);
    float side = right.x * up.y < right.y * up.x ? -1.0 : 1.0;
    vec3 u_axis = side * (dFdx(world_position) * up.y - dFdy(world_position) * right.y);
    vec3 v_axis = side * (dFdy(world_position) * right.x - dFdx(world_position) * up.x);
    float angle = 0.5 * atan(twice.y, twice.x + 1e-6);
    vec3 along = cos(angle) * unit_or_zero(u_axis) + sin(angle) * unit_or_zero(v_axis);
    wear.along = unit_or_zero(along - dot(along, n) * n);
    wear.across = cross(n, wear.along);
    wear.scratched = min(length(twice), 1.0);
    wear.width = 2.5 + 1.5 * sin(9.0 * angle);
    wear.reflectance = reflectance;
}

// A slit's diffraction: density of the light over the direction cosine across it, for each primary.
vec3 slit_density(float u) {
    vec3 x = PI * wear.width * u / LAMBDA + 1e-4;
    vec3 wave = sin(x) / x;
    return wear.width / LAMBDA * wave * wave;
}
#endif

// Call it in uniform control flow.
void read_wear(vec3 n, vec3 reflectance) {
    vec2 at = map_coordinates(5, WEAR_MAP);
    vec4 texel = texture(wear_map, at);
    wear.dust = texel.r;
    wear.grease = texel.g;
    wear.light = vec3(0.0);
#ifdef WEAR_SCRATCHES
    read_scratch(at, (texel.ba * 255.0 - 128.0) / 127.0, n, reflectance);
#endif
}

// Adds a light, as add_light() does. A density over direction cosines is a radiance per irradiance on the surface.
void wear_light(vec3 irradiance, float n_l, vec3 l, vec3 v, float variance) {
    wear.light += wear.dust / PI * DUST_ALBEDO * n_l * irradiance;
#ifdef WEAR_SCRATCHES
    if (wear.scratched < 0.004) return;
    variance += SCRATCH_VARIANCE;
    float u = dot(l + v, wear.along);
    float density = exp(-0.5 * u * u / variance) * inversesqrt(2.0 * PI * variance);
    wear.light += wear.scratched * n_l * density * slit_density(dot(l + v, wear.across)) * wear.reflectance * irradiance;
#endif
}

#ifdef WEAR_SCRATCHES
// What a scratch shows of the environment: at the mirror's direction and at both sides of it on the scratch's arc,
// weighted by a slit's diffraction without its fringes.
vec3 scratch_reflection(vec3 n, vec3 v) {
    float v_t = dot(v, wear.along);
    float v_h = dot(v, wear.across);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = -1; i <= 1; ++i) {
        float u = 0.35 * float(i);
        float s_h = u - v_h;
        float s_n2 = 1.0 - v_t * v_t - s_h * s_h;
        if (s_n2 <= 0.0) continue;
        float weight = 1.0 / (1.0 + 16.0 * u * u);
        vec3 direction = sqrt(s_n2) * n + s_h * wear.across - v_t * wear.along;
        sum += weight * environment_light(direction, SCRATCH_ROUGHNESS);
        weights += weight;
    }
    return sum / max(weights, 1e-6);
}
#endif

// The surface's radiance with its marks.
vec3 worn(vec3 radiance, vec3 n, vec3 v, vec3 diffuse_light) {
    float left = max(1.0 - wear.dust, 0.0);
    vec3 sum = wear.dust * DUST_ALBEDO * diffuse_light + wear.light;
#ifdef WEAR_SCRATCHES
    float scratched = left * wear.scratched;
    if (scratched > 0.004) {
        sum += scratched * wear.reflectance * scratch_reflection(n, v);
        left -= scratched;
    }
#endif
    return sum + left * radiance;
}
#endif
