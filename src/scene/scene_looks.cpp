// What molecules and the picture look like by what they do and where they are: "colorBy" and "water".
#include "scene/scene_reader.h"

namespace shoal {

namespace {

std::vector<glm::dvec3> readColors(JsonReader& r, const std::string& key) {
    const JsonValue& list = *r.raw(key);
    const auto wrong = [&](const JsonValue& value, size_t i) {
        const std::string path = concat(r.path(), ".", key, "[", i, "]");
        return Error(Location{r.file(), value.line, value.column, path},
                     "expected a colour: three numbers from 0 to 1");
    };
    if (list.kind != JsonValue::Kind::array)
        throw Error(r.at(key), concat("expected an array of colours, found ", name(list.kind)));
    std::vector<glm::dvec3> out;
    for (size_t i = 0; i < list.items.size(); ++i) {
        const JsonValue& item = list.items[i];
        if (item.kind != JsonValue::Kind::array || item.items.size() != 3) throw wrong(item, i);
        glm::dvec3 color(0);
        for (int c = 0; c < 3; ++c) {
            const JsonValue& part = item.items[size_t(c)];
            if (part.kind != JsonValue::Kind::number || !(part.number >= 0 && part.number <= 1))
                throw wrong(part, i);
            color[c] = part.number;
        }
        out.push_back(color);
    }
    if (out.size() < leastScaleColors || out.size() > mostScaleColors)
        throw Error(r.at(key), concat("expected ", leastScaleColors, " to ", mostScaleColors,
                                      " colours, found ", out.size()));
    return out;
}

}  // namespace

std::optional<ColorScale> readColorScale(JsonReader& group) {
    auto r = group.object("colorBy");
    if (!r) return {};
    for (const char* key : {"color", "secondColor"})
        if (group.has(key))
            throw Error(group.at(key), concat("\"", key, "\" has no effect beside \"colorBy\""));
    ColorScale scale;
    int quantity = 0;
    r->choose("quantity", {"speed"}, quantity);
    scale.quantity = static_cast<ColorScale::Quantity>(quantity);
    r->get("from", scale.from);
    r->need("to", scale.to);
    if (scale.to - scale.from < leastPositive)
        throw Error(r->at("to"),
                    concat("expected \"to\" above \"from\" (", scale.from, "), found ", scale.to));
    if (r->raw("colors")) scale.colors = readColors(*r, "colors");
    r->finish();
    return scale;
}

std::optional<Water> readWater(JsonReader& scene) {
    auto r = scene.object("water");
    if (!r) return {};
    Water water;
    r->get("surface", water.surface);
    r->get("extinction", water.extinction, Range::between(0, mostExtinction));
    getColor(*r, "scattering", water.scattering);
    r->get("caustics", water.caustics, Range::between(0, 1));
    r->get("causticsSize", water.causticsSize, aboveZero());
    r->get("causticsSpeed", water.causticsSpeed, Range::atLeast(0));
    r->get("rays", water.rays, Range::between(0, 1));
    r->finish();
    return water;
}

}  // namespace shoal
