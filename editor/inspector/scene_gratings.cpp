#include "editor/inspector/scene_gratings.h"

#include <algorithm>

namespace rowland::inspector {

void SceneGratings::reset() {
    others_.reset();
    all_.clear();
    sources_.clear();
}

void SceneGratings::want_others(const Document& document, const std::shared_ptr<GratingCook>& cook) {
    std::vector<Source> others(all_.size());
    bool any = false;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (i != document.chosen()) others[i] = document.accepted(i);
        any = any || others[i];
    }
    others_.want(any ? std::optional(others) : std::nullopt,
                 [cook, others](const std::stop_token& stop, const auto& publish) -> std::optional<Cooked> {
                     Cooked made{others, Gratings(others.size()), {}};
                     for (std::size_t i = 0; i < others.size(); ++i) {
                         if (!others[i]) continue;
                         if (stop.stop_requested()) return std::nullopt;
                         try {
                             made.gratings[i] = cook->cook(*others[i]);
                             publish(made);
                         } catch (const std::exception& error) {
                             made.failures.emplace_back(error.what());
                         }
                     }
                     return made;
                 });
}

bool SceneGratings::update(const Document& document, const std::shared_ptr<GratingCook>& cook, const Grating& chosen) {
    all_.resize(document.material_count());
    sources_.resize(all_.size());
    want_others(document, cook);
    bool news = false;
    const auto take = [&](std::size_t i, const Source& source, const Grating& grating) {
        if (!grating || source != document.accepted(i) || sources_[i] == source) return;
        sources_[i] = source;
        all_[i] = grating;
        news = true;
    };
    if (others_.poll().value) {
        const Cooked& made = *others_.value();
        if (!others_.busy()) failures_ = made.failures;
        for (std::size_t i = 0; i < std::min(all_.size(), made.sources.size()); ++i)
            take(i, made.sources[i], made.gratings[i]);
    }
    take(document.chosen(), document.accepted(), chosen);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (document.accepted(i)) continue;
        news = news || all_[i];
        all_[i] = nullptr;
        sources_[i] = nullptr;
    }
    return news;
}

}  // namespace rowland::inspector
