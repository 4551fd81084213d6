// The table of modules/thin_film/bake/film_table.h: three stacks of layers, one for each column of M.
TEXTURE_UNIT(8) uniform sampler3D film_table;
uniform vec4 film_path;  // x: n^2 - 1 of the outermost layer; y, z: scale and bias from the path difference in nm to rows;
                         // w: the last layer
uniform vec4 film_axes;  // x, y: scale and bias from sqrt(cosine) to columns; z: layers per unit of roughness;
                         // w: a slice's width

// Light in the working space to what a film reflects of it.
mat3 film_matrix(float cosine, float thickness_nm, float roughness) {
    float path_nm = 2.0 * thickness_nm * sqrt(film_path.x + cosine * cosine);
    float layer = min(roughness * film_axes.z, film_path.w) + 0.5;
    vec3 at = vec3(sqrt(cosine) * film_axes.x + film_axes.y, path_nm * film_path.y + film_path.z, layer * film_axes.w);
    const vec3 next = vec3(0.0, 0.0, 1.0 / 3.0);
    return mat3(textureLod(film_table, at, 0.0).rgb, textureLod(film_table, at + next, 0.0).rgb,
                textureLod(film_table, at + 2.0 * next, 0.0).rgb);
}
