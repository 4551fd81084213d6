#include "engine/core/json_schema.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rowland {

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;
using Kind = JsonShape::Kind;

/// A bound as a whole number where it is one.
Json bound(double value) {
    const bool whole = std::floor(value) == value && std::abs(value) < 1e15;
    return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json number_schema(const char* type, const NumberRange& range) {
    constexpr double kAnyNumber = 1e30;  // larger bounds, such as a float's range, are not stated
    Json schema = {{"type", type}};
    if (range.minimum > -kAnyNumber)
        schema[range.exclusive_minimum ? "exclusiveMinimum" : "minimum"] = bound(range.minimum);
    if (range.maximum < kAnyNumber)
        schema[range.exclusive_maximum ? "exclusiveMaximum" : "maximum"] = bound(range.maximum);
    return schema;
}

Json empty_object() {
    return {{"type", "object"}, {"properties", Json::object()}};
}

Json array_schema(Json items, const JsonShape& shape) {
    Json schema = {{"type", "array"}};
    if (shape.least > 0) schema["minItems"] = shape.least;
    if (shape.most > 0) schema["maxItems"] = shape.most;
    schema["items"] = std::move(items);
    return schema;
}

Json schema_of(const JsonShape& shape) {
    switch (shape.kind) {
        case Kind::Any:
            return Json::object();
        case Kind::Number:
            return number_schema("number", shape.range);
        case Kind::Integer:
            return number_schema("integer", shape.range);
        case Kind::Boolean:
            return {{"type", "boolean"}};
        case Kind::Numbers:
            return array_schema(number_schema("number", shape.range), shape);
        case Kind::Object:
            return empty_object();
        case Kind::Objects:
            return array_schema(empty_object(), shape);
        case Kind::ObjectOrObjects:
            return {{"oneOf", {empty_object(), array_schema(empty_object(), shape)}}};
        case Kind::Choice:
            if (shape.choices.size() == 1) return {{"const", shape.choices[0]}};
            return {{"enum", shape.choices}};
        case Kind::Text:
            break;
    }
    Json schema = {{"type", "string"}};
    if (shape.least > 0) schema["minLength"] = shape.least;
    return schema;
}

class SchemaRecorder final : public JsonRecorder {
 public:
    SchemaRecorder(std::shared_ptr<Json> document, std::vector<Pointer> objects)
        : document_(std::move(document)), objects_(std::move(objects)) {}

    void record(const std::string& key, bool required, const JsonShape& shape) override {
        for (const Pointer& object : leaves()) {
            Json& schema = (*document_)[object];
            Json& property = schema["properties"][key];
            if (property.is_null() || property.empty()) property = schema_of(shape);
            if (!required) continue;
            Json& keys = schema["required"];
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
        }
    }

    std::shared_ptr<JsonRecorder> child(const std::string& key) override {
        std::vector<Pointer> children;
        for (const Pointer& object : leaves()) {
            const Pointer member = object / "properties" / key;
            const Json& schema = (*document_)[member];
            if (schema.contains("items"))
                children.push_back(member / "items");
            else if (schema.contains("oneOf"))
                children.insert(children.end(), {member / "oneOf" / 0, member / "oneOf" / 1 / "items"});
            else
                children.push_back(member);
        }
        return std::make_shared<SchemaRecorder>(document_, children);
    }

    std::vector<std::shared_ptr<JsonRecorder>> split(std::size_t count) override {
        std::vector<std::vector<Pointer>> parts(count);
        for (const Pointer& object : leaves()) {
            Json& schema = (*document_)[object];
            schema = {{"oneOf", Json::array_t(count, schema)}};
            for (std::size_t i = 0; i < count; ++i) parts[i].push_back(object / "oneOf" / i);
        }
        std::vector<std::shared_ptr<JsonRecorder>> recorders;
        for (const std::vector<Pointer>& part : parts)
            recorders.push_back(std::make_shared<SchemaRecorder>(document_, part));
        return recorders;
    }

    void close() override {
        for (const Pointer& object : leaves()) (*document_)[object]["additionalProperties"] = false;
    }

    void annotate(const std::string& key, std::string_view keywords) override {
        const Json more = Json::parse(keywords);
        for (const Pointer& object : leaves()) (*document_)[object / "properties" / Pointer("/" + key)].update(more);
    }

    void also_allows(const std::string& key, std::string_view schema) override {
        for (const Pointer& object : leaves()) {
            Json& member = (*document_)[object / "properties" / Pointer("/" + key)];
            if (!member.contains("oneOf")) member = {{"oneOf", Json::array_t{member}}};
            member["oneOf"].push_back(Json::parse(schema));
        }
    }

 private:
    /// The objects, or the alternatives into which they were split.
    std::vector<Pointer> leaves() const {
        std::vector<Pointer> found = objects_;
        for (std::size_t i = 0; i < found.size();) {
            const Json& schema = (*document_)[found[i]];
            if (!schema.contains("oneOf")) {
                ++i;
                continue;
            }
            const Pointer alternatives = found[i] / "oneOf";
            found.erase(found.begin() + static_cast<std::ptrdiff_t>(i));
            for (std::size_t k = 0; k < schema["oneOf"].size(); ++k) found.push_back(alternatives / k);
        }
        return found;
    }

    std::shared_ptr<Json> document_;
    std::vector<Pointer> objects_;
};

}  // namespace

nlohmann::ordered_json json_schema(const std::string& title, const std::function<void(JsonReader&)>& parse) {
    const auto document = std::make_shared<Json>(empty_object());
    JsonReader reader(std::make_shared<SchemaRecorder>(document, std::vector<Pointer>{Pointer()}));
    parse(reader);
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
    schema.update(*document);
    return schema;
}

}  // namespace rowland
