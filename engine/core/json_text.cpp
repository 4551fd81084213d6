#include "engine/core/json_text.h"

#include <algorithm>

#include "engine/core/check.h"

namespace rowland {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string quoted(const std::string& text) {
    return OrderedJson(text).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

bool has_line_break(std::string_view text) {
    return text.find('\n') != std::string_view::npos;
}

}  // namespace

JsonText::JsonText(std::string text) : text_(std::move(text)), colon_(": ") {
    const std::vector<Member> first = members(root());
    if (first.empty()) return;
    colon_ = at({first[0].key.end, first[0].value.begin});
    const std::string_view gap = at({root().begin + 1, first[0].begin()});
    if (!has_line_break(gap)) return;
    newline_ = gap.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
    unit_ = gap.substr(gap.rfind('\n') + 1);
}

std::string_view JsonText::at(Range range) const {
    return std::string_view(text_).substr(range.begin, range.end - range.begin);
}

JsonText::Range JsonText::root() const {
    const std::size_t begin = skip_space(text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    return {begin, end_of_value(begin)};
}

std::size_t JsonText::skip_space(std::size_t position) const {
    return std::min(text_.find_first_not_of(kSpace, position), text_.size());
}

std::size_t JsonText::end_of_string(std::size_t position) const {
    for (++position; text_.at(position) != '"'; ++position)
        if (text_[position] == '\\') ++position;
    return position + 1;
}

std::size_t JsonText::end_of_value(std::size_t position) const {
    if (text_.at(position) == '"') return end_of_string(position);
    if (text_[position] != '{' && text_[position] != '[')
        return std::min(text_.find_first_of(",]} \t\r\n", position), text_.size());
    for (int depth = 0;;) {
        position = text_.find_first_of("\"{}[]", position);
        if (text_.at(position) == '"') {
            position = end_of_string(position);
            continue;
        }
        depth += text_[position] == '{' || text_[position] == '[' ? 1 : -1;
        ++position;
        if (depth == 0) return position;
    }
}

std::vector<JsonText::Member> JsonText::members(Range container) const {
    const bool is_object = text_[container.begin] == '{';
    std::vector<Member> found;
    for (std::size_t position = skip_space(container.begin + 1); position + 1 < container.end;) {
        Member& member = found.emplace_back();
        if (is_object) {
            member.key = {position, end_of_string(position)};
            position = skip_space(skip_space(member.key.end) + 1);
        }
        member.value = {position, end_of_value(position)};
        position = skip_space(member.value.end);
        if (text_[position] == ',') position = skip_space(position + 1);
    }
    return found;
}

std::string JsonText::key_of(const Member& member) const {
    return OrderedJson::parse(at(member.key)).get<std::string>();
}

std::optional<JsonText::Range> JsonText::child(Range container, const std::string& step) const {
    const char kind = text_[container.begin];
    if (kind != '{' && kind != '[') return std::nullopt;
    const std::vector<Member> all = members(container);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (step == (kind == '{' ? key_of(all[i]) : std::to_string(i))) return all[i].value;
    return std::nullopt;
}

std::optional<JsonText::Range> JsonText::range_of(const JsonPath& path) const {
    std::optional<Range> range = root();
    for (const std::string& step : path)
        if (range) range = child(*range, step);
    return range;
}

std::optional<std::string_view> JsonText::find(const JsonPath& path) const {
    const std::optional<Range> range = range_of(path);
    return range ? std::optional(at(*range)) : std::nullopt;
}

JsonText::Layout JsonText::layout_of(Range container, const std::vector<Member>& all) const {
    Layout layout{.between = {}, .colon = colon_};
    if (all.empty()) {
        if (newline_.empty()) return layout;
        const std::size_t line = text_.rfind('\n', container.begin) + 1;
        layout.between = newline_ + text_.substr(line, skip_space(line) - line) + unit_;
        return layout;
    }
    if (all.back().key.end > 0) layout.colon = at({all.back().key.end, all.back().value.begin});
    const std::size_t after = all.size() > 1 ? all[all.size() - 2].value.end : container.begin + 1;
    std::string_view gap = at({after, all.back().begin()});
    gap.remove_prefix(std::min(gap.find(',') + 1, gap.size()));
    if (all.size() == 1 && !has_line_break(gap)) gap = layout.colon.ends_with(' ') ? " " : "";
    layout.between = gap;
    return layout;
}

/// Objects have a line for each member where the container's members have; arrays of numbers stay on one line.
std::string JsonText::write(const OrderedJson& value, const Layout& layout) const {
    if (!value.is_structured() || value.empty())
        return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    const bool nested =
        value.is_object() || std::ranges::any_of(value, [](const OrderedJson& one) { return one.is_structured(); });
    const bool lines = nested && has_line_break(layout.between);
    const std::string space = layout.colon.ends_with(' ') ? " " : "";
    const Layout inner{.between = lines ? layout.between + unit_ : space, .colon = layout.colon};
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (!text.empty()) text += "," + inner.between;
        if (value.is_object()) text += quoted(key) + layout.colon;
        text += write(member, inner);
    }
    if (lines)
        return (value.is_object() ? "{" : "[") + inner.between + text + layout.between +
               (value.is_object() ? "}" : "]");
    return value.is_object() ? "{" + space + text + space + "}" : "[" + text + "]";
}

void JsonText::add(Range container, const std::string* key, std::string value, const Layout& layout) {
    ROWLAND_CHECK(text_[container.begin] == (key ? '{' : '['), "a member needs an object, an element an array");
    const std::vector<Member> all = members(container);
    if (key) value = quoted(*key) + layout.colon + value;
    if (!all.empty()) {
        replace({all.back().value.end, all.back().value.end}, "," + layout.between + value);
        return;
    }
    const std::size_t indent = layout.between.size() - std::min(unit_.size(), layout.between.size());
    replace({container.begin + 1, container.end - 1}, layout.between + value + layout.between.substr(0, indent));
}

void JsonText::replace(Range range, std::string_view by) {
    text_.replace(range.begin, range.end - range.begin, by);
}

void JsonText::set(const JsonPath& path, const OrderedJson& value) {
    Range range = root();
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (const auto next = child(range, path[i])) {
            range = *next;
            continue;
        }
        OrderedJson added = value;
        for (std::size_t k = path.size() - 1; k > i; --k) added = OrderedJson{{path[k], added}};
        const Layout layout = layout_of(range, members(range));
        add(range, &path[i], write(added, layout), layout);
        return;
    }
    const OrderedJson old = OrderedJson::parse(at(range));
    if (old == value) return;
    if (!old.is_object() || !value.is_object()) {
        const std::size_t line = text_.rfind('\n', range.begin) + 1;
        const std::string indent = newline_ + text_.substr(line, skip_space(line) - line);
        replace(range, write(value, {.between = newline_.empty() ? "" : indent, .colon = colon_}));
        return;
    }
    JsonPath member = path;
    member.emplace_back();
    for (const auto& [key, ignored] : old.items()) {
        member.back() = key;
        if (!value.contains(key)) remove(member);
    }
    for (const auto& [key, part] : value.items()) {
        member.back() = key;
        set(member, part);
    }
}

void JsonText::append(const std::string& array, const OrderedJson& value) {
    if (const std::optional<Range> range = range_of({array}))
        append_text(array, write(value, layout_of(*range, members(*range))));
    else
        set({array}, OrderedJson::array({value}));
}

void JsonText::append_text(const std::string& array, std::string value) {
    const std::optional<Range> range = range_of({array});
    ROWLAND_CHECK(range.has_value(), "an element is copied from an array that is there");
    add(*range, nullptr, std::move(value), layout_of(*range, members(*range)));
}

void JsonText::remove(const JsonPath& path) {
    const std::optional<Range> container = range_of({path.begin(), path.end() - 1});
    const std::optional<Range> value = range_of(path);
    if (!container || !value) return;
    const std::vector<Member> all = members(*container);
    const auto here =
        std::ranges::find_if(all, [&](const Member& member) { return member.value.begin == value->begin; });
    if (all.size() == 1)
        replace({container->begin + 1, container->end - 1}, "");
    else if (here + 1 == all.end())
        replace({(here - 1)->value.end, here->value.end}, "");
    else
        replace({here->begin(), (here + 1)->begin()}, "");
}

}  // namespace rowland
