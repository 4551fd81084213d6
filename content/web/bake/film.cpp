// Thin films: the table of modules/thin_film/bake/film_table.h.
#include <glm/matrix.hpp>
#include <string_view>

#include "content/web/bake/exports.h"
#include "engine/colour/colour_space.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/runtime/film_texels.h"

namespace rowland::web {

/// Of a film material file's JSON, as JSON.stringify() gives it: film_path and film_axes of film_lookup.glsl, whether
/// rows are roughnesses, the table's largest error, width and height of the texture; then its texels, RGBA. From
/// `thinnest_nm` to the file's thickness, and from `smoothest` to its roughness, a texture varies them; one of the
/// ranges must be empty. A negative limit: no texture does. `red`, `green`, `blue`: the base's reflectance at normal
/// incidence instead of the file's base, unless `red` is negative.
ROWLAND_EXPORT(film_table)
Numbers* film_table(const char* json, std::size_t size, double thinnest_nm, double smoothest, double red, double green,
                    double blue) {
    using namespace thin_film;
    FilmMaterial material = parse_film_material(nlohmann::json::parse(std::string_view(json, size)), "material");
    if (thinnest_nm >= 0.0) material.range.thinnest_nm = thinnest_nm;
    if (smoothest >= 0.0) material.range.smoothest = smoothest;
    if (red >= 0.0) material.film.base = NormalReflectance{.rgb = {red, green, blue}};
    // The page's halves are finer than the nine bits of a cooked table.
    const FilmColour colour(material.film, colour::LightSpectra(material.illuminant));
    const FilmTable table = bake_table(colour, material.range, table_size(material.range), true);
    const FilmAxes axes = film_axes(table);
    auto* numbers = new Numbers;
    append(axes.path, *numbers);
    append(axes.axes, *numbers);
    append(glm::vec2(has_roughnesses(table) ? 1 : 0, table.error.largest), *numbers);
    append(glm::vec2(texture_size(table)), *numbers);
    for (const glm::vec4& texel : working_columns(table, glm::inverse(colour::rec709_to_xyz())))
        append(texel, *numbers);
    return numbers;
}

}  // namespace rowland::web
