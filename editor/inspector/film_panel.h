#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/physics/film_curves.h"
#include "engine/core/computed.h"

namespace rowland::inspector {

/// A window about a thin film: its fields, what it reflects over wavelength and angle, and its colours over thickness
/// by the exact sum, by the table that is drawn and by glTF's formula.
class FilmPanel {
 public:
    /// Between Ui::begin_frame() and Ui::draw(), if it is open.
    void draw(ControlMap& controls);
    /// Whether curves are being computed.
    bool busy() const { return curves_.busy(); }

    bool open = false;

 private:
    void draw_fields(ControlMap& controls);
    void draw_curves(const FilmCurves& curves, ControlMap& controls) const;

    FilmInputs inputs_;
    Computed<FilmInputs, FilmCurves> curves_;
};

}  // namespace rowland::inspector
