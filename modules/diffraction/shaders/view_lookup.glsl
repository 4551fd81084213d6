// Texture coordinates of a tangent-frame view in a table, as bake/view_mapping.h lays views out. VIEW_MAPPING is defined
// by the program.
#define SPHERICAL 0
#define PARABOLIC 1
#define ONE_DIMENSIONAL 2

// Views below the horizon are clamped to it: such vertices are visible only in triangles that cross the silhouette.
// `nodes`: the texture's size.
vec2 view_coordinates(vec3 view, vec2 nodes) {
    const float HALF_PI = 1.57079632679490;
#if VIEW_MAPPING == SPHERICAL
    float theta = min(atan(length(view.xy), view.z), HALF_PI);
    float phi = view.x == 0.0 && view.y == 0.0 ? 0.0 : atan(view.y, view.x);
    return vec2(phi / (4.0 * HALF_PI), theta / HALF_PI * (1.0 - 1.0 / nodes.y)) + 0.5 / nodes;
#elif VIEW_MAPPING == PARABOLIC
    vec2 p = view.xy / (1.0 + max(view.z, 0.0));
    return 0.5 + p * (0.5 - 0.5 / nodes);
#else
    return vec2(0.5 + view.x * (0.5 - 0.5 / nodes.x), 0.5);
#endif
}
