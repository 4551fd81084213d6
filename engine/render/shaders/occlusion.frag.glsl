#version 450 core
// engine/render/effects.h. Positions are in the camera's axes, metres.
layout(binding = 0) uniform sampler2D depth_map;
uniform vec2 extent;         // half of the picture at depth 1
uniform vec2 planes;         // near, far
uniform float radius;        // of ambient occlusion, metres
uniform float contact;       // length of the ray toward the light, metres
uniform vec3 toward_light;

layout(location = 0) out vec4 visibility;

const float PI = 3.14159265358979;
const int SLICES = 2;
const int STEPS = 6;           // along each half of a slice
const int CONTACT_STEPS = 8;
const float FAR_AWAY = 60000.0;
const float FULL_WEIGHT = 0.85;  // of the radius: occluders beyond count less and less

vec2 size = vec2(textureSize(depth_map, 0));

// Depth along the axis.
float depth_at(ivec2 texel) {
    float d = texelFetch(depth_map, clamp(texel, ivec2(0), ivec2(size) - 1), 0).r;
    return d < 1.0 ? planes.x * planes.y / (planes.y - d * (planes.y - planes.x)) : FAR_AWAY;
}

vec3 position_at(ivec2 texel) {
    vec2 ndc = (vec2(texel) + 0.5) / size * 2.0 - 1.0;
    float z = depth_at(texel);
    return vec3(ndc * extent * z, -z);
}

// The side on which the depth changes less belongs to the same surface.
vec3 slope(vec3 before, vec3 here, vec3 after) {
    vec3 a = here - before;
    vec3 b = after - here;
    return abs(a.z) < abs(b.z) ? a : b;
}

vec3 normal_at(ivec2 texel, vec3 here) {
    vec3 x = slope(position_at(texel - ivec2(1, 0)), here, position_at(texel + ivec2(1, 0)));
    vec3 y = slope(position_at(texel - ivec2(0, 1)), here, position_at(texel + ivec2(0, 1)));
    return normalize(cross(x, y));
}

// The horizon's cosine from v, raised by what is seen at a texel. `lowest`: the surface's own horizon.
float raised(float horizon, float lowest, ivec2 texel, vec3 here, vec3 v) {
    vec3 toward = position_at(texel) - here;
    float distance = length(toward);
    float weight = clamp((radius - distance) / ((1.0 - FULL_WEIGHT) * radius), 0.0, 1.0);
    return max(horizon, mix(lowest, dot(toward, v) / max(distance, 1e-6), weight));
}

// Integral of the cosine from the normal, at angle n from the view, up to a horizon at angle h.
float arc(float h, float n) { return 0.25 * (cos(n) + 2.0 * h * sin(n) - cos(2.0 * h - n)); }

float slice_visibility(ivec2 texel, vec3 here, vec3 normal, vec3 v, vec2 direction, float reach, float offset) {
    vec3 across = vec3(direction, 0.0) - dot(vec3(direction, 0.0), v) * v;
    vec3 axis = normalize(cross(across, v));
    vec3 projected = normal - axis * dot(normal, axis);
    float weight = length(projected);
    float cosine = clamp(dot(projected, v) / max(weight, 1e-6), 0.0, 1.0);
    float n = (dot(across, projected) < 0.0 ? -1.0 : 1.0) * acos(cosine);
    vec2 lowest = vec2(cos(n + 0.5 * PI), cos(n - 0.5 * PI));
    vec2 horizon = lowest;
    for (int i = 0; i < STEPS; ++i) {
        float at = (float(i) + offset) / float(STEPS);
        vec2 away = direction * (1.0 + at * at * reach);
        horizon.x = raised(horizon.x, lowest.x, texel + ivec2(round(away)), here, v);
        horizon.y = raised(horizon.y, lowest.y, texel - ivec2(round(away)), here, v);
    }
    float right = n + clamp(acos(clamp(horizon.x, -1.0, 1.0)) - n, 0.0, 0.5 * PI);
    float left = n + clamp(-acos(clamp(horizon.y, -1.0, 1.0)) - n, -0.5 * PI, 0.0);
    return weight * (arc(right, n) + arc(left, n));
}

float ambient_visibility(ivec2 texel, vec3 here, vec3 normal, vec2 pattern) {
    vec3 v = normalize(-here);
    float reach = min(0.5 * radius * size.y / (extent.y * -here.z), 0.25 * size.y);
    float sum = 0.0;
    for (int i = 0; i < SLICES; ++i) {
        float angle = PI * (float(i) + pattern.x) / float(SLICES);
        sum += slice_visibility(texel, here, normal, v, vec2(cos(angle), sin(angle)), reach, pattern.y);
    }
    return clamp(sum / float(SLICES), 0.0, 1.0);
}

// Visibility along a short ray toward the light. A visible surface blocks it if the ray passes behind that surface by
// less than `contact`, since its thickness is unknown; blockers count less toward the ray's end.
float contact_visibility(vec3 here, vec3 normal, float offset) {
    float texel = 2.0 * extent.y * -here.z / size.y;
    if (contact <= 0.0 || dot(normal, toward_light) <= 0.0) return 1.0;
    float blocked = 0.0;
    vec3 start = here + normal * texel;
    for (int i = 0; i < CONTACT_STEPS; ++i) {
        float along = (float(i) + offset) / float(CONTACT_STEPS);
        vec3 at = start + along * contact * toward_light;
        vec2 uv = 0.5 + 0.5 * at.xy / (extent * -at.z);
        float behind = -at.z - depth_at(ivec2(floor(uv * size)));
        if (behind > 0.5 * texel && behind < contact) blocked = max(blocked, 1.0 - along * along);
    }
    return 1.0 - blocked;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 here = position_at(texel);
    visibility = vec4(1.0, 1.0, -here.z, 1.0);
    if (-here.z >= FAR_AWAY) return;
    vec3 normal = normal_at(texel, here);
    if (dot(normal, here) > 0.0) normal = -normal;
    // 4x4 pixels have each of 16 rotations and each of 16 offsets once: fewer rotations would show as fans of stripes.
    ivec2 in_pattern = texel & 3;
    int rotation = 4 * ((in_pattern.x + 2 * in_pattern.y) & 3) + in_pattern.y;
    vec2 pattern = (vec2(rotation, (5 * rotation) & 15) + 0.5) / 16.0;
    visibility.x = ambient_visibility(texel, here, normal, pattern);
    visibility.y = contact_visibility(here, normal, pattern.y);
}
