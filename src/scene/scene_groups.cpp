// "groups": which molecules, how many, and where they sit.
#include <algorithm>
#include <cmath>

#include "molecule/molecule_file.h"
#include "scene/scene_file.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

void readGrid(JsonReader& r, Placement& place) {
    r.get("origin", place.origin);
    r.need("spacing", place.spacing);
    std::vector<int> cells;
    r.need("cells", cells, Range::between(1, maxGroupCount));
    if (cells.size() != 3)
        throw Error(r.at("cells"), concat("expected three whole numbers, found ", cells.size()));
    place.cells = {cells[0], cells[1], cells[2]};
}

void readItems(JsonReader& r, Placement& place) {
    r.require("items");
    for (JsonReader& entry : r.objects("items")) {
        Placement::Item item;
        entry.get("position", item.position);
        getRotation(entry, "rotation", item.rotation);
        entry.get("scale", item.scale, aboveZero());
        entry.finish();
        place.items.push_back(item);
    }
    if (place.items.empty()) throw Error(r.at("items"), "expected at least one item");
}

void readHost(JsonReader& r, Placement& place, const std::vector<Model>& models) {
    switch (place.kind) {
    case Placement::Kind::vertices:
    case Placement::Kind::surface:
        place.model = needModel(r, "model", models);
        if (auto select = r.object("select"))
            place.select = readSelection(*select, models[size_t(place.model)]);
        place.align = Placement::Align::normal;
        break;
    case Placement::Kind::volume:
        r.require("box");
        getBox(r, "box", place.box, true);
        break;
    case Placement::Kind::grid:
        readGrid(r, place);
        break;
    case Placement::Kind::list:
        readItems(r, place);
        place.turn = Placement::Turn::none;  // the items say how they stand
        break;
    }
}

Placement readPlacement(JsonReader& r, const std::vector<Model>& models) {
    Placement place;
    int kind = 0, align = 0, turn = 0;
    r.require("on");
    r.choose("on", {"vertices", "surface", "volume", "grid", "list"}, kind);
    place.kind = static_cast<Placement::Kind>(kind);
    readHost(r, place, models);

    if (r.choose("align", {"none", "up", "normal"}, align)) {
        place.align = static_cast<Placement::Align>(align);
        const bool hasNormals =
            place.kind == Placement::Kind::vertices || place.kind == Placement::Kind::surface;
        if (place.align == Placement::Align::normal && !hasNormals)
            throw Error(r.at("align"),
                        "align \"normal\" needs a model to sit on (on \"vertices\" or \"surface\")");
    }
    if (r.choose("turn", {"none", "yaw", "any"}, turn)) place.turn = static_cast<Placement::Turn>(turn);
    r.get("tilt", place.tilt, Range::between(0, 3.141592653589794));
    r.get("droop", place.droop, Range::between(0, 1));
    getSpan(r, "scale", place.scale, aboveZero());
    r.get("offset", place.offset);
    r.finish();
    return place;
}

// How many molecules the place itself makes: 0 where only "count" can say.
double placesOf(const Placement& place) {
    if (place.kind == Placement::Kind::list) return static_cast<double>(place.items.size());
    if (place.kind != Placement::Kind::grid) return 0;
    const glm::dvec3 cells(place.cells);
    return cells.x * cells.y * cells.z;
}

int readCount(JsonReader& r, const Placement& place) {
    const double places = placesOf(place);
    double count = places;
    if (places == 0) r.require("count");
    if (r.get("count", count, Range::any())) {
        if (count != std::floor(count) || count < 1)
            throw Error(r.at("count"), concat("expected a whole count of at least 1, found ", count));
        if (places > 0 && count > places)
            throw Error(r.at("count"), concat("expected a count of at most ", places,
                                              ", the number of places, found ", count));
    }
    if (count > maxGroupCount)
        throw Error(r.at("count"), concat("expected a count of at most ", maxGroupCount,
                                          " (2^24: single precision counts no further), found ",
                                          static_cast<long long>(std::min(count, 1e18))));
    return static_cast<int>(count);
}

void readDrag(JsonReader& r, Drag& drag) {
    const JsonValue* value = r.raw("drag");
    if (!value) return;
    if (value->kind == JsonValue::Kind::object) {
        auto parts = r.object("drag");
        parts->need("normal", drag.normal, Range::atLeast(0));
        parts->need("tangent", drag.tangent, Range::atLeast(0));
        parts->finish();
        return;
    }
    r.get("drag", drag.normal, Range::atLeast(0));
    drag.tangent = drag.normal;
}

void readRelease(JsonReader& r, Group& group, std::vector<Warning>& warnings) {
    r.get("held", group.held);
    auto release = r.object("release");
    if (!release) return;
    Release out;
    getOptional(*release, "force", out.force, aboveZero());
    getOptional(*release, "rate", out.rate, aboveZero());
    release->get("after", out.after, Range::atLeast(0));
    if (!out.force && !out.rate)
        throw Error(release->here(), "expected a \"force\" or a \"rate\" at which pins let go");
    release->finish();
    if (!group.held)
        throw Error(r.at("release"),
                    "nothing to release: \"held\" is false, so pins are free from the start");
    if (!group.molecule.hasPins())
        warnings.push_back({r.at("release"), "nothing to release: the molecule has no pinned vertex"});
    group.release = out;
}

void readContact(JsonReader& r, Group& group) {
    auto contact = r.object("contact");
    if (!contact) return;
    GroupContact out;
    out.location = contact->here();
    contact->need("radius", out.radius, aboveZero());
    if (contact->get("triangles", out.triangles) && out.triangles && group.molecule.triangles.empty())
        throw Error(contact->at("triangles"), "the molecule has no triangles");
    contact->get("self", out.self);
    contact->finish();
    group.contact = out;
}

// "molecule" or "particle": what the group is made of.
void readKind(JsonReader& r, Group& group) {
    if (auto particle = r.object("particle")) {
        for (const char* key : {"molecule", "color", "secondColor"})
            if (r.has(key))
                throw Error(r.at(key),
                            concat("\"", key, "\" is of molecules, and this group has a particle"));
        group.particle = readParticleType(*particle);
        group.molecule = moleculeOf(*group.particle);
        return;
    }
    if (!r.has("molecule")) throw Error(r.here(), "missing key: give a \"molecule\" or a \"particle\"");
    group.molecule = readMolecule(needFile(r, "molecule"));
}

Group readGroup(JsonReader& r, const std::vector<Model>& models, std::vector<Warning>& warnings) {
    Group group;
    group.location = r.here();
    readKind(r, group);
    group.name = group.molecule.name;
    r.get("name", group.name);

    // what is born needs nothing to start with
    if (!r.has("emitters")) r.require("place");
    if (auto place = r.object("place")) {
        group.place = readPlacement(*place, models);
        group.count = readCount(r, group.place);
    } else if (r.has("count")) {
        throw Error(r.at("count"), "expected a \"place\" for those at the start");
    }
    readLife(r, group, models);
    readSchool(r, group);

    readDrag(r, group.drag);
    readRelease(r, group, warnings);
    r.get("stiffness", group.stiffness, Range::atLeast(0));
    r.get("damping", group.damping, Range::atLeast(0));
    r.get("velocity", group.velocity);
    r.get("spin", group.spin);
    r.get("phaseSpread", group.phaseSpread, Range::atLeast(0));
    r.get("collide", group.collide);
    readContact(r, group);
    getSurface(r, group.surface);
    r.get("restitution", group.restitution, Range::between(0, 1));
    r.get("friction", group.friction, Range::atLeast(0));
    getColor(r, "color", group.color);
    getColor(r, "secondColor", group.secondColor);
    group.colorBy = readColorScale(r);
    const bool forEver = !group.life || (group.life->life.y >= longestLife && !group.life->afterContact);
    if (group.particle && forEver)
        for (Warning& warning : agelessWarnings(*group.particle, r.at("particle")))
            warnings.push_back(std::move(warning));
    r.finish();
    return group;
}

}  // namespace

Selection readSelection(JsonReader& r, const Model& model) {
    Selection select;
    getOptional(r, "thinnest", select.thinnest, Range{0, 1, true});
    getOptional(r, "maxThickness", select.maxThickness, aboveZero());
    if (r.get("object", select.object)) {
        std::vector<std::string> names;
        for (const Mesh::Object& object : model.mesh.objects)
            names.push_back(object.name);
        bool known = false;
        for (const std::string& name : names)
            known = known || name == select.object;
        if (!known)
            throw Error(r.at("object"), "model \"" + model.name + "\" has no object \"" + select.object +
                                            "\"" + suggestion(select.object, names));
    }
    getColor(r, "color", select.color);
    if (r.get("colorTolerance", select.colorTolerance, Range::atLeast(0)) && !select.color)
        throw Error(r.at("colorTolerance"), "colorTolerance needs a color");
    getOptional(r, "minHeight", select.minHeight, Range::any());
    getOptional(r, "maxHeight", select.maxHeight, Range::any());
    if (select.minHeight && select.maxHeight && *select.minHeight > *select.maxHeight)
        throw Error(r.at("maxHeight"), concat("expected maxHeight of at least minHeight (", *select.minHeight,
                                              "), found ", *select.maxHeight));
    r.finish();
    return select;
}

std::vector<Group> readGroups(JsonReader& scene, const std::vector<Model>& models,
                              std::vector<Warning>& warnings) {
    scene.require("groups");
    std::vector<Group> groups;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("groups")) {
        groups.push_back(readGroup(r, models, warnings));
        if (r.has("name")) refuseRepeated(r, names, groups.back().name);
        names.push_back(groups.back().name);
    }
    if (groups.empty()) throw Error(scene.at("groups"), "expected at least one group, found none");
    checkDeaths(groups);
    checkSchools(groups);
    return groups;
}

}  // namespace shoal
