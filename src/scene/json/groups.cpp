// "groups": which molecules or particles, how many, where they sit, and what happens to them.
#include <algorithm>

#include "core/data_paths.h"
#include "core/describe.h"
#include "core/json_build.h"
#include "molecule/gap.h"
#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"
#include "scene/json/reader.h"
#include "scene/selection.h"

namespace shoal {

namespace {

// How many molecules a place itself makes: 0 where only "count" can say.
double placesOf(const Placement& place) {
    if (place.kind == Placement::Kind::list) return static_cast<double>(place.items.size());
    if (place.kind != Placement::Kind::grid) return 0;
    const glm::dvec3 cells(place.cells);
    return cells.x * cells.y * cells.z;
}

void checkItems(const Placement& place, const Where& where) {
    if (place.kind == Placement::Kind::list && place.items.empty())
        throw Error(where.locate("items"), "expected at least one item");
}

void checkCount(double count, const Placement& place, const Where& where) {
    const double places = placesOf(place);
    if (places > 0 && count > places)
        throw Error(where.locate("count"), "expected a count of at most ", places,
                    ", the number of places, found ", count);
}

void deriveCount(Group& group, const Where& where) {
    if (!where.given("place")) {
        // what is born needs nothing to start with
        if (!where.given("emitters")) where.require("place");
        if (where.given("count"))
            throw Error(where.locate("count"), "expected a \"place\" for those at the start");
        return;
    }
    checkItems(group.place, where.in("place"));
    if (where.given("count")) return;
    const double places = placesOf(group.place);
    if (places == 0) where.require("count");
    if (places > maxGroupCount)
        throw Error(where.in("place").locate("cells"), "expected at most ", maxGroupCount, " places, found ",
                    places);
    group.count = int(places);
}

// ---- Drag

void readDrag(JsonReader& r, Group& group, void*) {
    const JsonValue* value = r.raw("drag");
    if (!value) return;
    if (value->kind == JsonValue::Kind::object) {
        auto parts = r.object("drag");
        describe(&group.drag).read(*parts, group.drag);
        return parts->finish();
    }
    if (value->kind != JsonValue::Kind::number)
        throw Error(r.locate("drag"), "expected a number, or an object of \"normal\" and \"tangent\", found ",
                    name(value->kind));
    r.get("drag", group.drag.normal, Range::atLeast(0));
    group.drag.tangent = group.drag.normal;
}

// ---- Life

constexpr const char* newbornKeys[] = {"scale", "turn", "spin", "grow", "shrink"};

std::vector<Emitter>& emittersOf(Group& group) {
    if (!group.life) group.life.emplace();
    return group.life->emitters;
}

const std::vector<Emitter>* lookAtEmitters(const Group& group) {
    return group.life ? &group.life->emitters : nullptr;
}

void deriveCapacity(const Group& group, Lifecycle& life, const Where& where) {
    if (const std::optional<int> usual = usualCapacity(group.count, life)) {
        life.capacity = *usual;
        return;
    }
    const bool tooMany = life.life.y < longestLife;
    throw Error(where.here(), "expected a \"capacity\" in \"life\": ",
                emitsFromDeaths(life) ? "what dies elsewhere sets how many are born"
                : tooMany ? concat("rate times span is ", mostAlive(group.count, life), ", more than the ",
                                   maxGroupCount, " that a group may have")
                          : "without a \"span\" nothing says how many may be alive");
}

void checkLife(const Group& group, const Where& where) {
    const Lifecycle& life = *group.life;
    const Where own = where.in("life");
    for (const char* key : newbornKeys)
        if (group.particle && own.given(key))
            throw Error(own.locate(key), "\"", key,
                        "\" is of newborn molecules, and this group has a particle");
    if (own.given("allocator") && life.emitters.empty())
        throw Error(own.locate("allocator"), "nothing is born here: an allocator needs \"emitters\"");
    if (life.capacity < group.count)
        throw Error(own.locate("capacity"), "expected a capacity of at least the count at the start, ",
                    group.count, ", found ", life.capacity);
    for (size_t i = 0; i < life.emitters.size(); ++i)
        if (life.emitters[i].from == Emitter::From::death && life.allocator != Allocator::gpu)
            throw Error(where.in("emitters", i).here(),
                        "only the allocator \"gpu\" can emit from deaths: how many there are is known "
                        "there, and \"",
                        name(life.allocator), "\" is asked for");
}

// ---- The whole

void derive(Group& group, const Where& where) {
    if (!group.particle && !where.given("molecule"))
        throw Error(where.here(), "missing key: give a \"molecule\" or a \"particle\"");
    if (group.particle)
        for (const char* key : {"molecule", "color", "secondColor", "variation"})
            if (where.given(key))
                throw Error(where.locate(key), "\"", key,
                            "\" is of molecules, and this group has a particle");
    if (group.particle) group.molecule = moleculeOf(*group.particle);
    if (!where.given("name")) group.name = group.molecule.name;
    deriveCount(group, where);
    deriveLife(group, where);
}

void checkContact(const GroupContact& contact, const Molecule& molecule, const Where& where) {
    if (contact.triangles && molecule.triangles.empty())
        throw Error(where.locate("triangles"), "the molecule has no triangles");
    if (!contact.closed) return;
    if (molecule.triangles.empty()) throw Error(where.locate("closed"), "the molecule has no triangles");
    const double least = leastClosingRadius(molecule);
    if (contact.radius > 0 && contact.radius < least)
        throw Error(where.locate("radius"), "spheres of ", contact.radius,
                    " m are too small to close its triangles: expected a radius of at least ", least, " m");
}

void checkGroup(const Group& group, const Where& where) {
    // its file was held to the same; a particle's follows from the type, whose colours may glow
    if (!where.given("molecule") && !group.particle) checkMolecule(group.molecule, where.in("molecule"));
    if (group.count != 0 || !group.life) {
        needWithin(where.locate("count"), group.count, Range::between(1, maxGroupCount));
        checkItems(group.place, where.in("place"));
        checkCount(group.count, group.place, where);
    }
    if (group.life) checkLife(group, where);
    describe(&group.drag).check(group.drag, where.in("drag"), largestNumber);
    if (group.contact) checkContact(*group.contact, group.molecule, where.in("contact"));
    if (group.colorBy)
        for (const char* key : {"color", "secondColor", "variation"})
            if (where.given(key))
                throw Error(where.locate(key), "\"", key, "\" has no effect beside \"colorBy\"");
}

}  // namespace

static std::string needMolecule(JsonReader& r) {
    std::string written;
    r.need("molecule", written);
    if (!isShippedName(written)) return needFile(r, "molecule");
    needNamed(written, shippedMolecules(), r.locate("molecule"), "no molecule that ships is called");
    return moleculeFile(written, r.file());
}

const Description& describe(const Group*) {
    using G = Group;
    static const auto readMoleculeOf = [](JsonReader& r, G& group, void*) {
        if (r.has("molecule") && !r.has("particle")) group.molecule = readMolecule(needMolecule(r));
    };
    static const Description description =
        Describe<G>("group", "Molecules or particles of one kind.")
            .location(&G::location)
            .byHand("molecule", {.notEmpty = true},
                    {"one that ships, by its name, or the name of a file", "The molecule."}, readMoleculeOf)
            .usually("required, or `particle`")
            .key("particle", &G::particle, {"", "A type of point particle instead of a molecule."})
            .key("count", &G::count,
                 {"", "How many there are at the start.", Range::between(1, maxGroupCount)})
            .unlessZero()
            .usually("all places of a grid or list, else required")
            .key("place", &G::place, {"", "Where those at the start are."})
            .usually("required without `emitters`")
            .key("name", &G::name, {"", "Its name in messages and in the panel; no two have the same."})
            .usually("the molecule's name")
            .color("color", &G::color,
                   {"", "The colour instead of the molecule's; alone it colours all instances alike."})
            .acts([](const G& group) { return toJson(instanceColors(group).first); })
            .color("secondColor", &G::secondColor,
                   {"", "Instances vary between the colour and this one, instead of the molecule's."})
            .acts([](const G& group) { return toJson(instanceColors(group).second); })
            .key("variation", &G::variation,
                 {"",
                  "By what share the brightness of instances varies; 0: those of one colour are all alike.",
                  Range::between(0, 1)})
            .usually("0.2 with a second colour, else 0")
            .acts([](const G& group) { return toJson(instanceColors(group).variation); })
            .key("colorBy", &G::colorBy, {"", "Colours by speed, in place of those."})
            .key("life", &G::life, {"", "Birth and death."})
            .list<emittersOf, lookAtEmitters>("emitters",
                                              "What molecules or particles of the group are born from.")
            .key("school", &G::school, {"", "How they steer by one another."})
            .byHand("drag", {.value = Form::Value::numberOrKeys, .range = Range::atLeast(0), .usual = 0},
                    {"number of at least 0, 1/s; or an object",
                     "How fast the fluid takes it along, as Stokes drag. The velocity v grows by drag · (u − "
                     "v) a "
                     "second, u being the fluid's."},
                    readDrag)
            .holdsKeys(describe(static_cast<const Drag*>(nullptr)))
            .key("velocity", &G::velocity, {"m/s", "The velocity at the start."})
            .key("spin", &G::spin, {"rad/s", "The turning at the start, about the molecule's placed origin."})
            .key("held", &G::held, {"", "Whether pinned vertices hold; else they are free from the start."})
            .key("release", &G::release, {"", "When pins let go."})
            .only("held", {"true"})
            .key("stiffness", &G::stiffness,
                 {"", "What multiplies the stiffness of every spring.", Range::atLeast(0)})
            .key("damping", &G::damping,
                 {"", "What multiplies the damping of every spring.", Range::atLeast(0)})
            .key("phaseSpread", &G::phaseSpread,
                 {"rad", "Each instance's muscles run ahead by a random phase of up to this.",
                  Range::atLeast(0)})
            .key("collide", &G::collide, {"", "Whether they meet colliders."})
            .key("contact", &G::contact, {"", "Contact with other molecules; without it they pass through."})
            .key("surface", &G::surface,
                 {"the name of a surface", "What they are made of, for `surfacePairs`."})
            .notEmpty()
            .key("restitution", &G::restitution,
                 {"", "The restitution against other groups: the larger of the two holds.",
                  Range::between(0, 1)})
            .key("friction", &G::friction,
                 {"", "The friction against other groups: the geometric mean of the two holds.",
                  Range::atLeast(0)})
            .derive(derive)
            .rule(checkGroup, R"({"anyOf": [{"required": ["place"]}, {"required": ["emitters"]}],
                "oneOf": [{"required": ["molecule"]},
                          {"required": ["particle"],
                           "not": {"anyOf": [{"required": ["color"]}, {"required": ["secondColor"]},
                                             {"required": ["variation"]}]}}],
                "if": {"required": ["place"],
                       "properties": {"place": {"properties": {"on": {"enum": ["vertices", "surface", "volume"]}}}}},
                "then": {"required": ["count"]}})");
    return description;
}

// ---- What only the whole scene can tell

namespace {

void checkModelIndex(int model, const std::vector<Model>& models, const Location& where) {
    if (models.empty()) throw Error(where, "expected a model to sit on (the scene has no models)");
    if (model < 0 || size_t(model) >= models.size())
        throw Error(where, "expected the number of a model, 0 to ", models.size() - 1, ", found ", model);
}

void checkObject(const Selection& select, const Model& model, const Where& where) {
    if (select.object.empty()) return;
    needNamed(select.object, namesOf(model.mesh.objects), where.locate("object"),
              "model \"" + model.name + "\" has no object");
}

void checkSurface(const Emitter& emitter, const std::vector<Model>& models, const Where& where) {
    checkModelIndex(emitter.model, models, where.locate("model"));
    const Model& model = models[size_t(emitter.model)];
    checkObject(emitter.select, model, where.in("select"));
    if (!(selectedArea(model.mesh, emitter.select) > 0))
        throw Error(where.here(), "nothing of model \"", model.name,
                    "\" matches the selection, expected triangles with an area to emit from");
}

void checkModelsOf(const Group& group, const std::vector<Model>& models, const Where& where) {
    if ((group.count != 0 || !group.life) && group.place.onModel()) {
        const Where place = where.in("place");
        checkModelIndex(group.place.model, models, place.locate("model"));
        const Model& model = models[size_t(group.place.model)];
        if (group.place.kind != Placement::Kind::vertices && model.mesh.triangles.empty())
            throw Error(place.locate("model"), "model \"", model.name, "\" ", noTriangles,
                        ", or \"on\": \"vertices\"");
        checkObject(group.place.select, model, place.in("select"));
    }
    if (!group.life) return;
    for (size_t i = 0; i < group.life->emitters.size(); ++i)
        if (group.life->emitters[i].from == Emitter::From::surface)
            checkSurface(group.life->emitters[i], models, where.in("emitters", i));
}

void checkDeaths(const std::vector<Group>& groups) {
    const std::vector<std::string> names = namesOf(groups);
    // Every way along the deaths must end: longer than there are groups, and it is a circle.
    const auto follow = [&](const auto& self, size_t g, size_t depth) -> void {
        if (!groups[g].life) return;
        for (const Emitter& emitter : groups[g].life->emitters) {
            if (emitter.from != Emitter::From::death) continue;
            const size_t source = needNamed(emitter.group, names, emitter.location, "no group is named");
            if (!groups[source].life)
                throw Error(emitter.location,
                            "none of \"" + emitter.group + "\" ever dies: it has no \"life\"");
            if (depth >= groups.size() || source == g)
                throw Error(emitter.location, "groups that are born from one another's deaths in a circle");
            self(self, source, depth + 1);
        }
    };
    for (size_t g = 0; g < groups.size(); ++g)
        follow(follow, g, 0);
}

}  // namespace

void deriveLife(Group& group, const Where& where) {
    if (!group.life) return;
    const bool given = where.given("life");
    if (!given) group.life->location = where.locate("emitters");
    if (!given || !where.in("life").given("capacity")) deriveCapacity(group, *group.life, where);
}

void checkGroups(const Scene& scene, const Where& where) {
    if (scene.groups.empty()) throw Error(where.locate("groups"), "expected at least one group, found none");
    for (size_t i = 0; i < scene.groups.size(); ++i) {
        const Where here = where.in("groups", i);
        if (here.given("name")) refuseRepeated(here, scene.groups, i);
        checkModelsOf(scene.groups[i], scene.models, here);
    }
    checkDeaths(scene.groups);
    checkSchools(scene.groups);
}

std::vector<Warning> warningsOf(const Group& group, const Where& where) {
    std::vector<Warning> out;
    if (group.release && !group.molecule.hasPins())
        out.push_back({where.locate("release"), "nothing to release: the molecule has no pinned vertex"});
    const bool forEver = !group.life || (group.life->life.y >= longestLife && !group.life->afterContact);
    if (group.particle && forEver)
        for (Warning& warning : agelessWarnings(*group.particle, where.locate("particle")))
            out.push_back(std::move(warning));
    return out;
}

}  // namespace shoal
