#include "editor/trade/compare_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>

#include "editor/trade/difference_image.h"
#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/picture_scene.h"
#include "editor/trade/results.h"
#include "editor/trade/sweep.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/outputs.h"
#include "engine/image/png.h"
#include "modules/diffraction/asset/method.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::trade {

namespace {

std::vector<glm::dvec3> radiance(const std::filesystem::path& material, const lighting::ProbeImage& probe,
                                 const std::string& method, const FrameSet& set) {
    if (method == "reference") {
        const diffraction::Material parsed = diffraction::load_material(material);
        return reference_radiance(parsed.grating, probe, colour::LightSpectra(parsed.quality.illuminant),
                                  all_frames(set));
    }
    const diffraction::Method setting = diffraction::parse_method(method);
    return shaded(cook(diffraction::load_material_json(material), material.string(), setting),
                  diffraction::EvaluationLight(probe, setting.key_lights, setting.window), set);
}

}  // namespace

CLI::App* CompareCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("compare", "Compare two methods on one scene: numbers and a picture");
    command->footer(
        "The scene is a disc of the material with a sphere of it over the hole, or the points of --frames. A method "
        "is\n"
        "\"reference\" or a setting, such as arc/bands=5/rank=8/key_lights=16. Writes quantity,value: relative RMS "
        "and\n"
        "largest error over the largest value (both XYZ), the mean error of Y where the scene is dark over its mean "
        "Y,\n"
        "CIEDE2000 on the display and, of the scene, the mean of HDR-FLIP: 0 looks the same, 1 could not be further.\n"
        "Example:\n"
        "  rowland-trade compare --material cd.json --probe sunset.hdr --method spikes/bands=5 --difference d.png");
    command->add_option("--material", material, "Material, JSON")->required()->type_name("FILE");
    command->add_option("--probe", probe, "Light probe, Radiance .hdr or OpenEXR")
        ->required()
        ->type_name("FILE[:MAPPING]");
    command
        ->add_option("--probe-mapping", mapping,
                     "How the image covers the sphere: equirect, angular, or auto (recognised)")
        ->check(CLI::IsMember({"auto", "equirect", "angular"}))
        ->capture_default_str();
    command->add_option("--method", method, "The method in question")->required()->type_name("METHOD");
    command->add_option("--against", against, "The method it is held to")->capture_default_str()->type_name("METHOD");
    command->add_option("--frames", frames, "Points, CSV vx,vy,vz,nx,ny,nz,gx,gy,gz, in place of the scene")
        ->type_name("FILE");
    command
        ->add_option(
            "--difference", difference,
            fmt::format("PNG of both pictures and of their difference, black (none) to yellow (CIEDE2000 of {}\n"
                        "or more)",
                        kFullDifference))
        ->type_name("FILE");
    command->add_option("--size", size, "Pixels of the picture")
        ->expected(2)
        ->check(CLI::Range(8, 1024))
        ->capture_default_str();
    command->add_option("--magnified", magnified, "Pixels of the PNG for each pixel's side")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    return command;
}

void CompareCommand::run() const {
    if (frames && difference)
        refuse_input("--difference", "", "--frames, which are no picture", "the tool's scene: no --frames");
    const ProbeFile file = parse_probe_file(probe, mapping);
    if (difference) {
        std::vector<std::filesystem::path> files = files_named_in(material);
        files.insert(files.end(), {material, file.path});
        check_outputs(files, std::array{Output{"--difference", *difference, ".png"}});
    }
    for (const std::string& name : {method, against})
        if (name != "reference")
            check_method(diffraction::load_material_json(material), material.string(), diffraction::parse_method(name));
    const lighting::ProbeImage image = read_probe(file.path, file.mapping);
    const PictureFrames scene = picture_frames(far_camera(), size[0], size[1]);
    const FrameSet set = frames ? frames_of_file("frames", *frames) : scene.frames;
    const std::vector<glm::dvec3> b = radiance(material, image, against, set);
    const std::vector<glm::dvec3> a = radiance(material, image, method, set);
    const MethodError error = frames ? compare(a, b) : compare_pictures(scene, a, b);
    if (difference) {
        const RgbPicture shown = difference_image(picture(scene, a), picture(scene, b), size[0], size[1], magnified);
        image::write_png(*difference, shown.width, shown.height, shown.rgb);
    }
    write_results(
        fmt::format("quantity,value\nrelative_rms,{:.6g}\nlargest,{:.6g}\ndark_absolute,{:.6g}\n"
                    "median_delta_e,{:.6g}\np95_delta_e,{:.6g}\n",
                    error.relative_rms, error.largest, error.dark_absolute, error.median_delta_e, error.high_delta_e));
    if (error.flip) write_results(fmt::format("hdr_flip,{:.6g}\n", *error.flip));
}

}  // namespace rowland::trade
