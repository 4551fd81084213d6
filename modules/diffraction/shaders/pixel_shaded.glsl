// The end of fragment stages that shade pixels. Before it, the program defines
//   vec3 diffracted_radiance(GrooveView view);
// in the working space, of a view above the horizon; called for all views, as it may use derivatives.
MaterialTerms material_terms() {
    GrooveView view = groove_view();
    vec3 sum = lights_from_vertices();
#ifdef GROOVE_MAP
    int parts = groove_parts(view);
    vec3 diffracted = vec3(0.0);
    for (int part = 0; part < parts; ++part) {
        GrooveView one = view;
        if (parts > 1) one = groove_part(part);
        if (one.pitch > 0.0) diffracted += one.coverage * (diffracted_radiance(one) + key_lights_at_pixel(one));
    }
    diffracted /= float(parts);
#else
    vec3 diffracted = diffracted_radiance(view) + key_lights_at_pixel(view);
#endif
    if (view.direction.z > 0.0 && view.pitch > 0.0) sum += diffracted;
    prepare_lights(view);
    return MaterialTerms(base_weight, mirror_weight, sum);
}
