#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "editor/inspector/cook_grating.h"
#include "editor/inspector/document.h"
#include "editor/inspector/preview.h"
#include "engine/core/computed.h"

namespace rowland::inspector {

/// The cooked gratings of all materials of a document, for the preview. The chosen one is cooked elsewhere; the others
/// are cooked here, in the background, once each.
class SceneGratings {
 public:
    using Source = std::shared_ptr<const MaterialSource>;
    using Grating = std::shared_ptr<const CookedGrating>;

    /// Forgets another document's gratings.
    void reset();
    /// Once a frame. `chosen`: the chosen material's, cooked; null while it is not. Returns whether one is new.
    bool update(const Document& document, const std::shared_ptr<GratingCook>& cook, const Grating& chosen);

    /// By material; null where there is none, or none yet. An edited one stays until its successor is cooked.
    const Gratings& all() const { return all_; }
    bool busy() const { return others_.busy(); }
    /// Why gratings could not be cooked, since the last call.
    std::vector<std::string> take_failures() { return std::exchange(failures_, {}); }

 private:
    void want_others(const Document& document, const std::shared_ptr<GratingCook>& cook);

    /// Results so far, with the sources that they are of.
    struct Cooked {
        std::vector<Source> sources;
        Gratings gratings;
        std::vector<std::string> failures;
    };

    Gratings all_;
    std::vector<Source> sources_;  ///< of all_
    std::vector<std::string> failures_;
    Computed<std::vector<Source>, Cooked> others_;
};

}  // namespace rowland::inspector
