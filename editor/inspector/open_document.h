#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/document.h"
#include "editor/inspector/preview_object.h"
#include "engine/core/computed.h"
#include "engine/core/log.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::inspector {

/// A shipped material.
struct Preset {
    const char* file;  ///< "cd"
    const char* name;
    const char* category;
};

/// The document that is edited, its scene, and its cooked gratings and films. Opens and saves files; cooks in the
/// background what is edited. Bad input becomes a message and changes nothing else. Needs a current context.
class OpenDocument {
 public:
    using Cooked = std::shared_ptr<const diffraction::CookedMaterial>;

    /// Starts with a new material, the preset "cd". `presets`: the folder of the shipped materials.
    OpenDocument(std::filesystem::path presets, Messages& messages);
    ~OpenDocument();
    OpenDocument(const OpenDocument&) = delete;
    OpenDocument& operator=(const OpenDocument&) = delete;

    Document& document() { return document_; }
    const Document& document() const { return document_; }
    /// How many times the document has been replaced.
    std::size_t replacements() const { return replacements_; }
    /// The open scene; null: the document is a material file.
    const SceneObject* scene() const { return object_ ? object_->scene.get() : nullptr; }
    /// The scene's meshes and materials on the GPU; null: no scene.
    const std::shared_ptr<const PreviewObject>& object() const { return object_; }
    /// The name of the chosen material of a scene, or of the document.
    std::string chosen_name() const;

    /// Opens a material, a glTF file, a picture of grooves or of a film's thickness, or a table of efficiencies. A glTF
    /// file is opened in the background. A material replaces the document; if a scene is open, it becomes the grating
    /// or the film of the chosen material.
    void open(const std::filesystem::path& path);
    /// Waits until the glTF file is open.
    void finish_opening();
    void cancel_opening();
    /// The glTF file that is being opened; empty: none.
    std::filesystem::path opening() const { return opening_path_ ? *opening_path_ : std::filesystem::path(); }
    /// Opens a shipped material ("cd") as the start of a new one, or attaches it to the scene's chosen material.
    /// Returns whether it could.
    bool open_preset(const std::string& name);
    /// The shipped materials, category by category.
    static std::span<const Preset> presets();
    /// Whether opening the file would replace the document.
    bool is_replaced_by(const std::filesystem::path& path) const;
    /// Replaces the scene by a new material.
    void close_scene();

    /// Without `over_changes`, saving over the changes of another program to a scene file only sets asks_to_overwrite.
    void save(bool over_changes = false);
    bool asks_to_overwrite = false;
    void save_as(const std::filesystem::path& path);

    /// The arguments with which the demo shows the document as edited. Unsaved edits are written to a copy, which later
    /// calls overwrite. Throws Error (system) if it cannot be written.
    std::vector<std::string> demo_arguments();

    /// Sets the grating or the film of the scene's chosen material from JSON text; removes it.
    void paste(const std::string& text);
    void remove();
    /// Sets a foil pattern (groove_texture.h) as the groove texture of the chosen material.
    void set_foil_pattern(const std::string& name);

    /// Call it every frame. Returns whether there is a new document, surface or message.
    bool update();
    /// Whether something is being opened or cooked, or will be.
    bool busy() const;
    bool cooking() const { return cooked_.busy(); }
    /// Whether cooked() is the document's.
    bool is_cooked() const { return cooked_.current(); }

    /// The grating of the chosen material as last cooked; null before the first, and without a grating.
    Cooked cooked() const {
        return document_.has_grating() && cooked_.value() ? (*cooked_.value())->material : nullptr;
    }
    /// The grating or film of the chosen material as last cooked, as edited or as saved; null: none, or not yet.
    std::shared_ptr<const CookedSurface> surface(bool as_saved) const;
    /// Those of all materials of a scene, with that of the chosen one as edited or as saved.
    CookedSurfaces surfaces(bool as_saved) const;
    /// The film of the chosen material as last cooked; null before the first, without a film, and if it is not drawn.
    std::shared_ptr<const thin_film::CookedFilm> film() const;

    /// The grating that the efficiency pane compares the material with: a scalar profile with the opened table, a table
    /// with the last scalar profile. nullopt: none.
    std::optional<diffraction::Grating> compared() const;

 private:
    struct OpenedScene {
        std::shared_ptr<const SceneObject> object;
        Document document;
    };
    using Opening = Computed<std::shared_ptr<const std::filesystem::path>, std::shared_ptr<OpenedScene>>;
    using Cooking = Computed<std::shared_ptr<const MaterialSource>, std::shared_ptr<const CookedSurface>>;

    void replace(Document document, std::shared_ptr<const PreviewObject> object);
    void replace(OpenedScene opened);
    void use_material(Document material, const std::filesystem::path& path);
    void start_opening();
    bool take_opened(const Opening::Change& change);
    void cook(Cooking& cooking, const std::shared_ptr<const MaterialSource>& source);
    void use_picture(std::vector<std::byte> picture, const std::string& name);
    void set_groove_texture(std::vector<std::byte> picture, const std::string& name);
    void set_texture(const Field& field, std::vector<std::byte> picture, const std::string& name);

    std::filesystem::path presets_;
    std::optional<std::filesystem::path> demo_copy_;  ///< removed at the end
    Messages& messages_;
    Document document_;
    std::size_t replacements_ = 0;
    std::shared_ptr<const PreviewObject> object_;
    std::shared_ptr<SurfaceCook> cook_;
    std::shared_ptr<const std::filesystem::path> opening_path_;
    std::optional<diffraction::EfficiencyTable> opened_table_;
    std::optional<diffraction::Grating> last_scalar_;  ///< the last cooked grating with a scalar profile

    // The destructors wait for the work, so these are last.
    SceneSurfaces scene_surfaces_;
    Opening opening_;
    Cooking cooked_;
    Cooking saved_;
};

/// Whether the file is a light: a probe image or recipe. Reads .json files to distinguish recipes from materials.
/// Throws Error (input).
bool is_light_file(const std::filesystem::path& path);
/// Whether the file is a PNG or JPEG, by its name.
bool is_picture_file(const std::filesystem::path& path);
/// Whether the file is a .json file with a foil recipe. Throws Error (input).
bool is_foil_recipe_file(const std::filesystem::path& path);

}  // namespace rowland::inspector
