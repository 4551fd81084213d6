#include "tests/support/json_schema.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace rowland::test {

namespace {

using nlohmann::json;

class Checker {
 public:
    explicit Checker(const json& root) : root_(root) {}

    bool check(const json& value, const json& schema) const {
        return std::all_of(schema.items().begin(), schema.items().end(),
                           [&](const auto& rule) { return check_rule(value, rule.key(), rule.value(), schema); });
    }

 private:
    bool check_rule(const json& value, const std::string& keyword, const json& rule, const json& schema) const {
        static const std::set<std::string> annotations = {"$schema", "title", "default", "$defs"};
        if (annotations.contains(keyword)) return true;
        if (keyword == "$ref") return check(value, root_.at(json::json_pointer(rule.get<std::string>().substr(1))));
        if (keyword == "type") return has_type(value, rule.get<std::string>());
        if (keyword == "const") return value == rule;
        if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
        if (keyword == "oneOf")
            return std::count_if(rule.begin(), rule.end(), [&](const json& option) { return check(value, option); }) ==
                   1;
        if (const auto result = check_number(value, keyword, rule)) return *result;
        if (const auto result = check_array(value, keyword, rule)) return *result;
        if (const auto result = check_object(value, keyword, rule, schema)) return *result;
        if (keyword == "minLength")
            return !value.is_string() || value.get<std::string>().size() >= rule.get<std::size_t>();
        throw std::runtime_error("the schema uses an unknown keyword: " + keyword);
    }

    static bool has_type(const json& value, const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "number") return value.is_number();
        if (type == "integer") return value.is_number_integer();
        throw std::runtime_error("the schema uses an unknown type: " + type);
    }

    static std::optional<bool> check_number(const json& value, const std::string& keyword, const json& rule) {
        static const std::set<std::string> keywords = {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum",
                                                       "multipleOf"};
        if (!keywords.contains(keyword)) return std::nullopt;
        if (!value.is_number()) return true;
        const double x = value.get<double>();
        const double bound = rule.get<double>();
        if (keyword == "minimum") return x >= bound;
        if (keyword == "maximum") return x <= bound;
        if (keyword == "exclusiveMinimum") return x > bound;
        if (keyword == "exclusiveMaximum") return x < bound;
        return std::fmod(x, bound) == 0.0;
    }

    std::optional<bool> check_array(const json& value, const std::string& keyword, const json& rule) const {
        static const std::set<std::string> keywords = {"items", "minItems", "maxItems", "uniqueItems"};
        if (!keywords.contains(keyword)) return std::nullopt;
        if (!value.is_array()) return true;
        if (keyword == "minItems") return value.size() >= rule.get<std::size_t>();
        if (keyword == "maxItems") return value.size() <= rule.get<std::size_t>();
        if (keyword == "uniqueItems") return std::set<json>(value.begin(), value.end()).size() == value.size();
        return std::all_of(value.begin(), value.end(), [&](const json& item) { return check(item, rule); });
    }

    std::optional<bool> check_object(const json& value, const std::string& keyword, const json& rule,
                                     const json& schema) const {
        static const std::set<std::string> keywords = {"required", "properties", "additionalProperties"};
        if (!keywords.contains(keyword)) return std::nullopt;
        if (!value.is_object()) return true;
        if (keyword == "required")
            return std::all_of(rule.begin(), rule.end(), [&](const json& key) { return value.contains(key); });
        for (const auto& [key, member] : value.items()) {
            const bool known = schema.at("properties").contains(key);
            if (keyword == "additionalProperties" && !known && rule == false) return false;
            if (keyword == "properties" && known && !check(member, rule.at(key))) return false;
        }
        return true;
    }

    const json& root_;
};

}  // namespace

bool satisfies(const nlohmann::json& value, const nlohmann::json& schema) {
    return Checker(schema).check(value, schema);
}

}  // namespace rowland::test
