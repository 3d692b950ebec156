// "colorBy" of a group: what molecules look like by what they do.
#include "scene/json/reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<ColorScale> auto& scale) {
    v.word("quantity", scale.quantity, {"speed"});
    v.number("from", scale.from);
    v.number("to", scale.to);
}

namespace {

void checkEnds(const ColorScale& scale, const Where& where) {
    if (scale.to - scale.from < leastPositive)
        throw Error(where.at("to"),
                    concat("expected \"to\" above \"from\" (", scale.from, "), found ", scale.to));
}

void checkNumber(size_t colors, const Location& where) {
    if (colors < leastScaleColors || colors > mostScaleColors)
        throw Error(where, concat("expected ", leastScaleColors, " to ", mostScaleColors, " colours, found ",
                                  colors));
}

constexpr const char* noColor = "expected a colour: three numbers from 0 to 1";

std::vector<glm::dvec3> readColors(JsonReader& r, const std::string& key) {
    const JsonValue& list = *r.raw(key);
    const auto wrong = [&](const JsonValue& value, size_t i) {
        const std::string path = concat(r.path(), ".", key, "[", i, "]");
        return Error(Location{r.file(), value.line, value.column, path}, noColor);
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
    checkNumber(out.size(), r.at(key));
    return out;
}

}  // namespace

std::optional<ColorScale> readColorScale(JsonReader& group) {
    auto r = group.object("colorBy");
    if (!r) return {};
    for (const char* key : {"color", "secondColor"})
        if (group.has(key))
            throw Error(group.at(key), concat("\"", key, "\" has no effect beside \"colorBy\""));
    ColorScale scale = readMembers<ColorScale>(*r, {"to"});
    checkEnds(scale, *r);
    if (r->raw("colors")) scale.colors = readColors(*r, "colors");
    r->finish();
    return scale;
}

void checkColorScale(const ColorScale& scale, const Where& where) {
    members(CheckScene(where), scale);
    checkEnds(scale, where);
    checkNumber(scale.colors.size(), where.at("colors"));
    for (size_t i = 0; i < scale.colors.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!contains(Range::between(0, 1), scale.colors[i][c]))
                throw Error(where.in("colors", i).here(), noColor);
}

}  // namespace shoal
