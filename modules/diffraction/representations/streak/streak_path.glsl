// Texture coordinates at which the nodes of a segment look up the streak map: streak_map.h.
TEXTURE_UNIT(11) uniform sampler3D streak_map;
uniform float map_scale;                        // of the stored values
uniform float streak_level;                     // log2 of a lobe's deviation over the map's

const float CHART_SCALE = 0.5 / 1.1;
const float RIM = 0.905;

// Stereographic projection of the half sphere above (`up` = 1) or below (-1) the world's horizon.
vec2 chart_position(vec3 s, float up) { return s.xz / max(1.0 + up * s.y, RIM); }

// xy: chart_position(); z: angle in the chart of the tangent `along`, as the map's third texture coordinate.
vec3 chart_coordinates(vec3 s, vec3 along, float up) {
    vec2 p = chart_position(s, up);
    vec2 image = along.xz - up * along.y * p;
    float diamond_angle = image.x / (abs(image.x) + abs(image.y));
    return vec3(p, 0.5 + 0.5 * (image.y < 0.0 ? diamond_angle : -diamond_angle));
}

// A parabola: middle + t slope + t^2 bend. xy: texture coordinates; z: that of the tangent's angle, linear in t.
struct StreakPath {
    vec3 middle;
    vec3 slope;
    vec2 bend;
};

// The path through chart_coordinates() of both ends, at t = -1 and 1, and the direction `centre`, at t = 0.
StreakPath streak_path(vec3 before, vec3 centre, vec3 after, float up) {
    after.z -= round(after.z - before.z);
    vec3 middle = 0.5 * (after + before);
    vec3 slope = 0.5 * (after - before);
    vec2 bend = middle.xy - chart_position(centre, up);
    middle.xy -= bend;
    vec2 chart = vec2(0.5 * CHART_SCALE, CHART_SCALE);
    middle.xy = vec2(0.5 - 0.25 * up, 0.5) + chart * middle.xy;
    slope.xy *= chart;
    bend *= chart;
    return StreakPath(middle, slope, bend);
}

vec3 streak_light(StreakPath path, float t, float level) {
    vec2 chart_at = path.middle.xy + t * (path.slope.xy + t * path.bend);
    return textureLod(streak_map, vec3(chart_at, path.middle.z + t * path.slope.z), level).rgb;
}
