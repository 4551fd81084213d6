// The probe's light as the surface reflects it: prefiltered, occluded by the scene around the surface, and replaced by
// the light of the plane and the objects that mirrors show.
TEXTURE_UNIT(0) uniform samplerCube environment_map;
TEXTURE_UNIT(1) uniform sampler2D brdf_table;

#ifdef AMBIENT_AT_VERTICES
in vec3 ambient_at_vertex;
#endif

// Split-sum scale and bias [Karis 2013]: a GGX lobe's albedo for reflectance 1 - (1 - cosine)^5 and for (1 - cosine)^5.
vec2 split_sum_dfg(float n_v, float roughness) { return texture(brdf_table, vec2(n_v, roughness)).rg; }

// The mean direction from which a GGX lobe gets its light, between the mirror's direction and the normal [Lagarde & de
// Rousiers 2014, 4.9.2]: prefiltered light has the lobe of a surface seen from in front. Measured under eight captured
// probes, a white metal of roughness .3, .6, .8 and 1 has relative RMS errors over views up to 80 degrees of 28, 20, 18
// and 10 % with this direction, 31, 30, 44 and 51 % with the mirror's. Not a unit vector.
vec3 lobe_direction(vec3 n, vec3 v, float roughness) {
    return mix(reflect(-v, n), n, roughness * roughness * roughness);
}

// Levels are linear in roughness, but between the mirror's level and the first rough one linear in the lobe's width,
// which is proportional to roughness squared.
float environment_level(float roughness) {
    float level = roughness * environment.x;
    return level * min(level, 1.0);
}

#if defined(ROUGH_REFLECTIONS) || defined(FILM_LOBE_NODES)
TEXTURE_UNIT(21) uniform sampler2D lobe_node_table;  // engine/lighting/lobe_nodes.h

const float LOBE_OFFSET = 0.02;  // kLobeCosineOffset

// The four nodes of a GGX lobe, one per component: the cosine of incidence on its microfacets, and the weight, the
// roughness and the lean of the look-up of their light, along mix(mirror's direction, normal, lean).
struct LobeNodes {
    vec4 cosines;
    vec4 weights;
    vec4 leans;
    vec4 roughnesses;
};

LobeNodes lobe_nodes(float n_v, float roughness) {
    float least = sqrt(LOBE_OFFSET);
    float root = (sqrt(n_v + LOBE_OFFSET) - least) / (sqrt(1.0 + LOBE_OFFSET) - least);
    float column = 0.5 * (root + 1.0 - sqrt(max(1.0 - n_v, 0.0)));
    vec2 size = vec2(textureSize(lobe_node_table, 0)) * vec2(1.0, 0.25);
    vec2 position = (vec2(column, sqrt(roughness)) * (size - 1.0) + 0.5) / (size * vec2(1.0, 4.0));
    vec4 planes[4];
    for (int i = 0; i < 4; ++i) planes[i] = textureLod(lobe_node_table, position + vec2(0.0, 0.25 * float(i)), 0.0);
    vec4 roots = sqrt(n_v + LOBE_OFFSET) + roughness * roughness * planes[0];
    return LobeNodes(clamp(roots * roots - LOBE_OFFSET, 0.0, 1.0), planes[1], roughness * roughness * planes[2],
                     min(roughness * planes[3], 1.0));
}
#endif

#ifdef LOCAL_REFLECTIONS
// The plane that a reflected ray meets: engine/render/reflections.h.
TEXTURE_UNIT(17) uniform sampler2D plane_map;

#ifdef AMBIENT_OCCLUSION
// x: visibility of ambient light at a point of the plane, in the picture at uv; y: whether the picture shows it there.
vec2 visibility_seen(vec2 uv, float depth) {
    vec3 texel = textureLod(visibility_map, uv, 0.0).xyz;
    return vec2(texel.x, max(1.0 - abs(texel.z / depth - 1.0) * 30.0, 0.0));
}
#endif

// Visibility of ambient light at a point of the plane, if the picture shows that point; else 1. Around a mirror's
// objects, what hides a point from the camera would have an outline: the mean of points nearby fades to 1.
float ambient_visibility_at(vec3 position) {
#ifdef AMBIENT_OCCLUSION
    vec4 clip = view_projection * vec4(position, 1.0);
    vec2 uv = 0.5 + 0.5 * clip.xy / clip.w;
    if (clip.w <= 0.0 || any(greaterThan(abs(uv - 0.5), vec2(0.5)))) return 1.0;
#ifdef OBJECT_REFLECTIONS
    const int TAPS = 8;
    vec2 size = vec2(textureSize(visibility_map, 0));
    vec2 reach = 0.04 * vec2(size.y / size.x, 1.0);
    vec2 turn = vec2(1.0, 0.0);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < TAPS; ++i) {
        vec2 seen = visibility_seen(uv + reach * next_of_disc(i, TAPS, turn), clip.w);
        sum += vec2(seen.x * seen.y, seen.y);
    }
    return 1.0 + (sum.x - sum.y) / float(TAPS);
#else
    vec2 seen = visibility_seen(uv, clip.w);
    return mix(1.0, seen.x, seen.y);
#endif
#else
    return 1.0;
#endif
}

// Not textureSize(plane_map, level): llvmpipe takes one pixel's level for its neighbours as well.
ivec2 plane_map_size(int level) { return max(textureSize(plane_map, 0) >> level, ivec2(1)); }

// The map repeats.
vec3 plane_texel(ivec2 texel, int level) {
    ivec2 size = plane_map_size(level);
    return texelFetch(plane_map, (texel % size + size) % size, level).rgb;
}

// Filtered here: where neighbours meet no plane, an anisotropic filter has no gradients, and llvmpipe's never returns.
vec3 plane_albedo(vec2 at, float footprint) {
    if (plane_size.w == 0.0) return plane_colour.rgb;
    vec2 uv = plane_uv_linear.xy * at.x + plane_uv_linear.zw * at.y + plane_uv_offset.xy;
    vec2 texels = vec2(textureSize(plane_map, 0)) * (abs(plane_uv_linear.xy) + abs(plane_uv_linear.zw));
    float width = footprint * max(texels.x, texels.y);
    int level = clamp(int(log2(max(width, 1.0)) + 0.5), 0, textureQueryLevels(plane_map) - 1);
    vec2 position = uv * vec2(plane_map_size(level)) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 part = position - vec2(corner);
    vec3 texel = mix(mix(plane_texel(corner, level), plane_texel(corner + ivec2(1, 0), level), part.x),
                     mix(plane_texel(corner + ivec2(0, 1), level), plane_texel(corner + ivec2(1, 1), level), part.x),
                     part.y);
    return mat3(rec709_to_working) * (plane_colour.rgb * texel);
}

// The plane's reflection of the environment toward the mirror.
vec3 plane_gloss(vec3 direction, float visibility) {
    float roughness = plane_normal.w;
    vec2 dfg = textureLod(brdf_table, vec2(-dot(direction, plane_normal.xyz), roughness), 0.0).rg;
    vec3 seen = lobe_direction(plane_normal.xyz, -direction, roughness);
    vec3 light = textureLod(environment_map, seen, environment_level(roughness)).rgb * environment.y;
    return light * ((0.04 * dfg.x + dfg.y) * visibility);
}

#ifdef SHADOWS
// Fraction of the lamp's light that reaches a point of the plane.
float plane_shadow(vec3 position) {
    vec3 at = shadow_coordinates(position, plane_normal.xyz, lights[0].position.xyz);
#ifdef OBJECT_REFLECTIONS
    return lit_fraction(at, plane_normal.xyz);
#else
    return shadow_tap(at);
#endif
}
#endif

// The light from a direction: that of the plane, if the ray meets it, in place of the environment's. A rough surface
// sees a blurred edge and map. `spread`: change of the direction over a pixel.
vec3 with_local_reflection(vec3 environment_radiance, vec3 direction, float roughness, float spread) {
    vec3 from = (world_to_plane * vec4(world_position, 1.0)).xyz;
    vec3 along = mat3(world_to_plane) * direction;
    if (along.y >= 0.0 || from.y <= 0.0) return environment_radiance;
    float distance = from.y / -along.y;
    vec2 at = from.xz + distance * along.xz;
    // Width of a GGX lobe, half of whose light is within an angle of about its roughness squared, plus the pixel's.
    float footprint =
        (2.0 * roughness * roughness + spread) * distance + plane_size.z * (distance + 1.0 / gl_FragCoord.w);
    vec2 inside = clamp((plane_size.xy - abs(at)) / footprint + 0.5, 0.0, 1.0);
    float coverage = inside.x * inside.y;
    if (coverage <= 0.0) return environment_radiance;
    vec3 met = world_position + distance * direction;
    float visibility = ambient_visibility_at(met);
    vec3 light = visibility * plane_ambient.rgb;
#ifdef SHADOWS
    light += plane_shadow(met) * plane_lamp.rgb;
#endif
    return mix(environment_radiance, plane_albedo(at, footprint) * light + plane_gloss(direction, visibility), coverage);
}
#endif

#ifdef OBJECT_REFLECTIONS
// What a reflected ray meets among the objects around its mirror: engine/render/reflections.h.
TEXTURE_UNIT(19) uniform samplerCube surrounding_light;     // alpha: 1 where an object is, else all are 0
TEXTURE_UNIT(20) uniform samplerCube surrounding_nearness;  // 1 / distance from the centre, metres; 0: nothing
uniform vec4 surroundings;  // xyz: the centre, world; w: angle of a texel, radians

const int MARCH_STEPS = 16;
const int HALVINGS = 5;
const float PASSED = 1.2;  // distance from the centre over the object's

// Direction from the centre to a point of a ray, at an angle from the ray's direction. `aside`: to the ray's nearest
// point.
vec3 toward_point(float angle, vec3 aside, vec3 direction) { return sin(angle) * aside + cos(angle) * direction; }

// Whether that point is more than `times` as far from the centre as the object there. `least`: the ray's least distance
// from the centre; the point's is least / sin(angle).
bool lies_behind_object(float times, float angle, vec3 aside, vec3 direction, float least) {
    vec3 toward = toward_point(angle, aside, direction);
    return textureLod(surrounding_nearness, toward, 0.0).r * least > times * sin(angle);
}

// Where a ray comes to be behind an object, between an angle at which it is not and one at which it is.
float first_behind_object(float before, float behind, vec3 aside, vec3 direction, float least) {
    for (int i = 0; i < HALVINGS; ++i) {
        float angle = 0.5 * (before + behind);
        if (lies_behind_object(1.0, angle, aside, direction, least)) behind = angle;
        else before = angle;
    }
    return behind;
}

// Radiance from a direction: of the object that the ray meets, or `beyond` if it meets none. `spread`: change of the
// direction over a pixel.
vec3 with_object_reflection(vec3 beyond, vec3 direction, float roughness, float spread) {
    vec3 from = world_position - surroundings.xyz;
    float along = dot(from, direction);
    vec3 foot = from - along * direction;
    float least = max(length(foot), 1e-6);
    vec3 aside = foot / least;
    float begin = atan(least, along);
    float met = -1.0;  // an angle at which the ray meets an object; below 0: none found
    float before = begin;
    bool behind = false;
    for (int i = 1; i <= MARCH_STEPS && met < 0.0; ++i) {
        float angle = begin * (1.0 - float(i) / float(MARCH_STEPS));
        bool was_behind = behind;
        behind = lies_behind_object(1.0, angle, aside, direction, least);
        if (behind) {
            float first = was_behind ? angle : first_behind_object(before, angle, aside, direction, least);
            // A ray that is far behind the object already there passes behind its outline, and may meet another one.
            if (!lies_behind_object(PASSED, first, aside, direction, least)) met = first;
        }
        before = angle;
    }
    if (met < 0.0) return beyond;
    // The GGX lobe's angle, as in with_local_reflection(), plus the pixel's.
    float footprint = 2.0 * roughness * roughness + spread;
    vec4 light = textureLod(surrounding_light, toward_point(met, aside, direction),
                            log2(max(footprint / surroundings.w, 1.0)));
    return beyond * (1.0 - light.a) + light.rgb;
}
#endif

// The direction from the probe to the point where the ray leaves the probe's box: where the probe captured the light
// that the ray meets [Lagarde & Zanuttini 2012]. Outside the box the ray begins at the box's nearest point. Not a unit
// vector.
vec3 captured_direction(vec3 direction) {
#ifdef LOCAL_PROBE
    vec3 along = mat3(world_to_box) * direction + 1e-20;  // not zero
    vec3 from = clamp((world_to_box * vec4(world_position, 1.0)).xyz, -1.0, 1.0);
    vec3 inverse_along = 1.0 / along;
    vec3 leaving = abs(inverse_along) - from * inverse_along;
    return mat3(box_to_world) * (from + min(leaving.x, min(leaving.y, leaving.z)) * along);
#else
    return direction;
#endif
}

// The environment's light as the scene near the surface hides and replaces it.
vec3 with_surroundings(vec3 light, vec3 direction, float roughness) {
#ifdef AMBIENT_OCCLUSION
    // Specular occlusion of a lobe of this perceptual roughness [Lagarde & de Rousiers 2014].
    float visible = screen_visibility.x;
    float cosine = abs(dot(direction, normalize(world_normal)));
    light *= clamp(pow(cosine + visible, exp2(-16.0 * roughness - 1.0)) - 1.0 + visible, 0.0, 1.0);
#endif
    float spread = 0.0;
#ifdef OBJECT_REFLECTIONS
    vec3 change = fwidth(direction);
    spread = max(change.x, max(change.y, change.z));
#endif
#ifdef LOCAL_REFLECTIONS
    light = with_local_reflection(light, direction, roughness, spread);
#endif
#ifdef OBJECT_REFLECTIONS
    light = with_object_reflection(light, direction, roughness, spread);
#endif
    return light;
}

vec3 environment_light(vec3 direction, float roughness) {
    vec3 light =
        textureLod(environment_map, captured_direction(direction), environment_level(roughness)).rgb * environment.y;
    return with_surroundings(light, normalize(direction), roughness);
}

#ifdef MATERIAL_CURVED_MIRROR
TEXTURE_UNIT(18) uniform samplerCube mirror_map;  // the environment with box-filtered levels

// What a mirror shows, averaged over the pixel: in a curved mirror a pixel covers many texels, and a lamp may be one of
// them. Uses derivatives: call it in uniform control flow.
vec3 mirrored_light(vec3 direction, vec3 n) {
    return with_surroundings(texture(mirror_map, captured_direction(direction)).rgb * environment.y, direction, 0.0);
}
#else
vec3 mirrored_light(vec3 direction, vec3 n) { return environment_light(direction, seen_roughness(0.0, n)); }
#endif
