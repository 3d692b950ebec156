// "groups": which molecules, how many, and where they sit.
#include <algorithm>
#include <cmath>

#include "molecule/molecule_file.h"
#include "molecule/rules.h"
#include "scene/json/reader.h"
#include "scene/json/scene_file.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<Placement::Item> auto& item) {
    v.number("position", item.position);
    v.rotation("rotation", item.rotation);
    v.number("scale", item.scale, aboveZero());
}

// But for those of where it is, which differ.
template <typename V>
static void members(V&& v, Either<Placement> auto& place) {
    v.word("turn", place.turn, {"none", "yaw", "any"});
    v.number("tilt", place.tilt, Range::between(0, 3.141592653589794));
    v.number("droop", place.droop, Range::between(0, 1));
    v.span("scale", place.scale, aboveZero());
    v.number("offset", place.offset);
}

template <typename V>
static void members(V&& v, Either<Selection> auto& select) {
    v.number("thinnest", select.thinnest, Range{0, 1, true});
    v.number("maxThickness", select.maxThickness, aboveZero());
    v.color("color", select.color);
    v.number("colorTolerance", select.colorTolerance, Range::atLeast(0));
    v.number("minHeight", select.minHeight);
    v.number("maxHeight", select.maxHeight);
}

template <typename V>
static void members(V&& v, Either<Drag> auto& drag) {
    v.number("normal", drag.normal, Range::atLeast(0));
    v.number("tangent", drag.tangent, Range::atLeast(0));
}

template <typename V>
static void members(V&& v, Either<Release> auto& release) {
    v.number("force", release.force, aboveZero());
    v.number("rate", release.rate, aboveZero());
    v.number("after", release.after, Range::atLeast(0));
}

template <typename V>
static void members(V&& v, Either<GroupContact> auto& contact) {
    v.number("radius", contact.radius, aboveZero());
    v.flag("triangles", contact.triangles);
    v.flag("self", contact.self);
}

// The numbers of the group itself.
template <typename V>
static void members(V&& v, Either<Group> auto& group) {
    v.number("stiffness", group.stiffness, Range::atLeast(0));
    v.number("damping", group.damping, Range::atLeast(0));
    v.number("velocity", group.velocity);
    v.number("spin", group.spin);
    v.number("phaseSpread", group.phaseSpread, Range::atLeast(0));
    v.flag("collide", group.collide);
    v.number("restitution", group.restitution, Range::between(0, 1));
    v.number("friction", group.friction, Range::atLeast(0));
    v.color("color", group.color);
    v.color("secondColor", group.secondColor);
}

namespace {

constexpr const char* noGroups = "expected at least one group, found none";
const std::vector<std::string> placeWords = {"vertices", "surface", "volume", "grid", "list"};
const std::vector<std::string> alignWords = {"none", "up", "normal"};
const Range cellCounts = Range::between(1, maxGroupCount);

bool onModel(const Placement& place) {
    return place.kind == Placement::Kind::vertices || place.kind == Placement::Kind::surface;
}

void checkAlign(const Placement& place, const Where& where) {
    if (place.align == Placement::Align::normal && !onModel(place))
        throw Error(where.at("align"),
                    "align \"normal\" needs a model to sit on (on \"vertices\" or \"surface\")");
}

void checkItems(const Placement& place, const Where& where) {
    if (place.items.empty()) throw Error(where.at("items"), "expected at least one item");
}

void checkRelease(const Release& release, const Where& where) {
    if (!release.force && !release.rate)
        throw Error(where.here(), "expected a \"force\" or a \"rate\" at which pins let go");
}

void checkSurfaced(const GroupContact& contact, const Molecule& molecule, const Where& where) {
    if (contact.triangles && molecule.triangles.empty())
        throw Error(where.at("triangles"), "the molecule has no triangles");
}

void checkSelection(const Selection& select, const Model& model, const Where& where) {
    if (!select.object.empty()) {
        std::vector<std::string> names;
        for (const Mesh::Object& object : model.mesh.objects)
            names.push_back(object.name);
        if (std::find(names.begin(), names.end(), select.object) == names.end())
            throw Error(where.at("object"), "model \"" + model.name + "\" has no object \"" + select.object +
                                                "\"" + suggestion(select.object, names));
    }
    if (select.minHeight && select.maxHeight && *select.minHeight > *select.maxHeight)
        throw Error(where.at("maxHeight"), concat("expected maxHeight of at least minHeight (",
                                                  *select.minHeight, "), found ", *select.maxHeight));
}

void readGrid(JsonReader& r, Placement& place) {
    r.get("origin", place.origin);
    r.need("spacing", place.spacing);
    std::vector<int> cells;
    r.need("cells", cells, cellCounts);
    if (cells.size() != 3)
        throw Error(r.at("cells"), concat("expected three whole numbers, found ", cells.size()));
    place.cells = {cells[0], cells[1], cells[2]};
}

void readItems(JsonReader& r, Placement& place) {
    r.require("items");
    for (JsonReader& entry : r.objects("items")) {
        place.items.push_back(readMembers<Placement::Item>(entry));
        entry.finish();
    }
    checkItems(place, r);
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
    int kind = 0;
    r.require("on");
    r.choose("on", placeWords, kind);
    place.kind = static_cast<Placement::Kind>(kind);
    readHost(r, place, models);
    ReadScene(r).word("align", place.align, alignWords);
    checkAlign(place, r);
    members(ReadScene(r), place);
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

void checkCount(double count, const Placement& place, const Where& where) {
    const double places = placesOf(place);
    if (count != std::floor(count) || count < 1)
        throw Error(where.at("count"), concat("expected a whole count of at least 1, found ", count));
    if (places > 0 && count > places)
        throw Error(where.at("count"),
                    concat("expected a count of at most ", places, ", the number of places, found ", count));
    if (count > maxGroupCount)
        throw Error(where.at("count"), concat("expected a count of at most ", maxGroupCount,
                                              " (2^24: single precision counts no further), found ",
                                              static_cast<long long>(std::min(count, 1e18))));
}

int readCount(JsonReader& r, const Placement& place) {
    double count = placesOf(place);
    if (count == 0) r.require("count");
    r.get("count", count, Range::any());
    checkCount(count, place, r);
    return static_cast<int>(count);
}

void readDrag(JsonReader& r, Drag& drag) {
    const JsonValue* value = r.raw("drag");
    if (!value) return;
    if (value->kind == JsonValue::Kind::object) {
        auto parts = r.object("drag");
        drag = readMembers<Drag>(*parts, {"normal", "tangent"});
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
    const Release out = readMembers<Release>(*release);
    checkRelease(out, *release);
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
    GroupContact out = readMembers<GroupContact>(*contact, {"radius"});
    out.location = contact->here();
    checkSurfaced(out, group.molecule, *contact);
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
    group.school = readDescribed<School>(r, "school");

    readDrag(r, group.drag);
    readRelease(r, group, warnings);
    members(ReadScene(r), group);
    readContact(r, group);
    if (r.get("surface", group.surface) && group.surface.empty())
        throw Error(r.at("surface"), "expected the name of a surface, found an empty string");
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
    auto select = readMembers<Selection>(r);
    if (r.get("object", select.object) && select.object.empty())
        throw Error(r.at("object"), "expected the name of an object, found an empty string");
    if (r.has("colorTolerance") && !select.color)
        throw Error(r.at("colorTolerance"), "colorTolerance needs a color");
    checkSelection(select, model, r);
    r.finish();
    return select;
}

static void checkPlace(const Placement& place, const std::vector<Model>& models, const Where& where) {
    const CheckScene check(where);
    check.word("on", place.kind, placeWords);
    check.word("align", place.align, alignWords);
    checkAlign(place, where);
    members(check, place);
    if (onModel(place)) {
        checkModel(place.model, models, where.at("model"));
        const Where select = where.in("select");
        members(CheckScene(select), place.select);
        checkSelection(place.select, models[size_t(place.model)], select);
    }
    if (place.kind == Placement::Kind::volume) check.box("box", place.box, true);
    if (place.kind == Placement::Kind::grid) {
        check.number("origin", place.origin);
        check.number("spacing", place.spacing);
        for (int i = 0; i < 3; ++i)
            check.number(concat("cells[", i, "]"), place.cells[i], cellCounts);
    }
    if (place.kind != Placement::Kind::list) return;
    checkItems(place, where);
    for (size_t i = 0; i < place.items.size(); ++i) {
        const Where item = where.in("items", i);
        members(CheckScene(item), place.items[i]);
    }
}

static void checkGroup(const Group& group, const std::vector<Model>& models, const Where& where) {
    if (group.particle) {
        checkParticle(*group.particle, where.in("particle"));
        Molecule point = group.molecule;
        point.material = Material();  // follows from the type, whose colours may glow
        checkMolecule(point, where.in("molecule"));
    } else {
        checkMolecule(group.molecule, where.in("molecule"));
    }
    if (group.count != 0 || !group.life) {
        checkPlace(group.place, models, where.in("place"));
        checkCount(group.count, group.place, where);
    }
    if (group.life) checkLife(group, models, where);
    if (group.school) describe(&*group.school).check(*group.school, where.in("school"), largestNumber);
    const Where drag = where.in("drag");
    members(CheckScene(drag), group.drag);
    if (group.release) {
        const Where release = where.in("release");
        members(CheckScene(release), *group.release);
        checkRelease(*group.release, release);
    }
    members(CheckScene(where), group);
    if (group.contact) {
        const Where contact = where.in("contact");
        members(CheckScene(contact), *group.contact);
        checkSurfaced(*group.contact, group.molecule, contact);
    }
    if (group.colorBy) checkColorScale(*group.colorBy, where.in("colorBy"));
}

void checkGroups(const std::vector<Group>& groups, const std::vector<Model>& models) {
    const Where whole;
    if (groups.empty()) throw Error(whole.at("groups"), noGroups);
    for (size_t i = 0; i < groups.size(); ++i)
        checkGroup(groups[i], models, whole.in("groups", i));
    checkDeaths(groups);
    checkSchools(groups);
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
    if (groups.empty()) throw Error(scene.at("groups"), noGroups);
    checkDeaths(groups);
    checkSchools(groups);
    return groups;
}

}  // namespace shoal
